"""Puts RG_QUOTIENT(a, b) in place of every `a / b` of floats in a text in GLSL, so that a program can choose how it divides.

GLSL has no operators of one's own, so the build rewrites them. Quotients of integers stay, and those of two literals, which
compilers reckon. Whether a quotient is of floats its divisor tells: a literal, a call, or a name with members, each of which the
text declares. What is none of these is refused.
"""
import collections
import re

TOKEN = re.compile(r"\d[\w.]*(?:(?<=[eE])[-+]\d+)?f?|\.\d[\w.]*|[A-Za-z_]\w*|<<|>>|[-+*/%<>=!&|^]=|&&|\|\||\S")
LITERAL = re.compile(r"[\d.]")
# What a text does not declare itself.
BUILTINS = {
    "RG_ROUGH_QUOTIENT": "float", "RG_ROUGH_ROOT": "float", "RG_ROOT": "float", "RG_QUOTIENT": "float", "floor": "float",
    "abs": "float", "float": "float", "uintBitsToFloat": "float", "RG_FLOAT_OF": "float", "int": "int", "RG_INT_OF": "int",
    "uint": "uint", "floatBitsToUint": "uint", "RG_UINT_OF": "uint", "gl_FragCoord": "vec4", "ivec3": "ivec3",
}
VECTORS = {"vec4": "float", "ivec4": "int", "ivec3": "int", "vec2": "float", "uvec4": "uint"}


class Refused(Exception):
    """A quotient that the build cannot tell the type of."""


class Text:
    """The tokens of a text, where each stands, and what it declares."""

    def __init__(self, text):
        self.text = text
        found = [match for match in TOKEN.finditer(text)]
        self.tokens = [match.group() for match in found]
        self.starts = [match.start() for match in found]
        self.ends = [match.end() for match in found]
        self.match = self.brackets()
        self.structs = {
            name: dict(self.members(body))
            for name, body in re.findall(r"\bstruct\s+(\w+)\s*\{([^}]*)\}", text)
        }
        kinds = "|".join(["float", "int", "uint", "bool", *VECTORS, *self.structs])
        self.results = dict(BUILTINS)
        self.results.update((name, kind) for kind, name in re.findall(rf"\b({kinds})\s+(\w+)\s*\(", text))
        declared = rf"\b({kinds})\s+(\w+)\s*(?=[=;,)])"
        # a name means what its last declaration before it says
        self.names = [(match.start(), match.group(2), match.group(1)) for match in re.finditer(declared, text)]

    @staticmethod
    def members(body):
        for member in filter(str.strip, body.split(";")):
            kind, names = member.split(None, 1)
            yield from ((name.strip(), kind) for name in names.split(","))

    def brackets(self):
        match, open_at = {}, []
        for at, token in enumerate(self.tokens):
            if token in ("(", "[", "{"):
                open_at.append(at)
            elif token in (")", "]", "}"):
                match[at] = open_at.pop()
                match[match[at]] = at
        return match

    def declared(self, name, place):
        kind = None
        for start, declared, its in self.names:
            if start > place:
                break
            if declared == name:
                kind = its
        return kind

    def primary_before(self, last):
        """The first token of the name, literal, call or bracket that ends with `last`."""
        while True:
            first = last
            if self.tokens[last] in (")", "]"):
                first = self.match[last]
                if re.match(r"[A-Za-z_]", self.tokens[first - 1]) and self.tokens[first - 1] != "return":
                    first -= 1
            if self.tokens[first - 1] != ".":
                return first
            last = first - 2

    def dividend(self, slash):
        """The first token of what stands before a `/`: all factors of its product."""
        first = self.primary_before(slash - 1)
        while self.tokens[first - 1] in ("*", "/", "%"):
            first = self.primary_before(first - 2)
        return first

    def term(self, first):
        """The first token behind signs, and the last one, of the term that begins with `first`."""
        while self.tokens[first] in ("-", "+"):
            first += 1
        last = self.match[first] if self.tokens[first] == "(" else first
        while self.tokens[last + 1] in (".", "(", "["):
            last = last + 2 if self.tokens[last + 1] == "." else self.match[last + 1]
        return first, last

    def kind(self, first, last):
        """The type of what stands from `first` to `last`, which begins with no sign; None: not known."""
        token = self.tokens[first]
        if token == "(":
            kind, at = self.kind_of_sum(first + 1, self.match[first] - 1), self.match[first]
        elif LITERAL.match(token):
            return "float" if re.search(r"[.f]", token) else "uint" if token.endswith("u") else "int"
        elif first < last and self.tokens[first + 1] == "(":
            kind, at = self.results.get(token), self.match[first + 1]
        else:
            kind, at = self.declared(token, self.starts[first]) or self.results.get(token), first
        while at < last and self.tokens[at + 1] == ".":
            kind = VECTORS.get(kind) or self.structs.get(kind, {}).get(self.tokens[at + 2])
            at += 2
        return kind if at == last else None

    def kind_of_sum(self, first, last):
        """The type of an expression: that of its first term, or of what a choice chooses."""
        at = first
        while at <= last:
            if self.tokens[at] == "?":
                first = at + 1
            at = self.match[at] if self.tokens[at] in ("(", "[") else at
            at += 1
        return self.kind(*self.term(first))

    def is_literal(self, first, last):
        return first == last and LITERAL.match(self.tokens[first])

    def quotients(self):
        """Of each quotient of floats: its first token, its `/` and its last token."""
        for slash, token in enumerate(self.tokens):
            if token == "/=":
                raise Refused("`/=`: write the quotient out")
            if token != "/":
                continue
            first, (second, last) = self.dividend(slash), self.term(slash + 1)
            kind = self.kind(second, last)
            if kind not in ("float", "int", "uint"):
                said = self.text[self.starts[first] : self.ends[last]]
                raise Refused(f"`{said}`: the build cannot tell what its divisor is; give it a name")
            if kind == "float" and not (self.is_literal(first, slash - 1) and self.is_literal(second, last)):
                yield first, slash, last


def rewrite(text):
    parsed = Text(text)
    found = list(parsed.quotients())
    firsts, slashes, lasts = (collections.Counter(tokens) for tokens in zip(*found)) if found else ({}, {}, {})
    done, at = [], 0
    for token, (start, end) in enumerate(zip(parsed.starts, parsed.ends)):
        if token in slashes:
            done += [text[at:start].rstrip(), ","]
        else:
            done += [text[at:start], "RG_QUOTIENT(" * firsts.get(token, 0), text[start:end], ")" * lasts.get(token, 0)]
        at = end
    return "".join(done) + text[at:]
