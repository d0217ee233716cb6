"""A fault that somebody might make in host code: a place of the source, and its replacement."""
import dataclasses
import re

OPERATOR = re.compile(r"(\+=|-=|<<|[-+*/%&|])\s")  # a place may begin with an operator; its left side is before it

@dataclasses.dataclass(frozen=True)
class Fault:
    file: str
    # The text around the place, which must occur once in the file. « and » enclose the place; without them it is the whole text.
    # A place is an expression, or statements that end with a semicolon or a brace.
    at: str
    new: str
    about: str
    lives: str = ""  # why no test can notice it
    tests: tuple = ()  # tried before the tests of its area

    @property
    def old(self):
        return self.at.split("«")[1].split("»")[0] if "«" in self.at else self.at

    @property
    def around(self):
        return self.at.replace("«", "").replace("»", "")

    def start_in(self, text):
        """The position of the place in the text of its file."""
        return text.index(self.around) + self.at.find("«") * ("«" in self.at)

    def with_switch(self, number, otherwise):
        """The copy's text: the fault, the text `otherwise`, and the switch that picks one."""
        if self.old.rstrip().endswith((";", "}")):
            return f"{{ if (rg_mutant({number})) {{ {self.new} }} else {{ {otherwise} }} }}"
        operator, new = OPERATOR.match(otherwise), self.new
        if not operator:
            return f"(rg_mutant({number}) ? ({new}) : ({otherwise}))"
        sign = operator[1]
        if new.startswith(sign + " "):
            return f"{sign} (rg_mutant({number}) ? ({new[len(sign):]}) : ({otherwise[len(sign):]}))"
        if sign not in "+-":
            raise ValueError(f"{self.file}: {self.around}: of {sign} only the right side can be another; take both sides")
        return f"+ (rg_mutant({number}) ? (0 {new}) : (0 {otherwise}))"
