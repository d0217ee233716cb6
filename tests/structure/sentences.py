#!/usr/bin/env python3
"""Sentences of README and docs are short and plain: sentences.py [--list] [FILE...].

At most 5 % of them have over 35 words, none over 60, and none begins as hard sentences do. Code blocks and tables are not sentences; a code
span or a link's address is one word."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LONG, LONGEST, SHARE = 35, 60, 0.05
# Openings whose subject or verb comes late.
BANNED = re.compile(r'(What (?!(?:\w+ ){0,4}\w+\?)|That are |Of those |Of these |So that )')


def blocks(text):
    """Paragraphs, items of lists and headings, with the line where each begins."""
    found, lines, start, fenced = [], [], 1, False
    for number, line in enumerate(text.splitlines() + [''], 1):
        if line.lstrip().startswith('```'):
            fenced = not fenced
            line = ''
        if not lines and re.match(r'    |\t', line):
            continue
        begins = re.match(r'\s*([-*+]|\d+\.)\s+|#+\s|\s*\||\s*>', line)
        if fenced or not line.strip() or begins:
            if lines:
                found.append((start, ' '.join(lines)))
            lines, start = [], number
        if not fenced and line.strip() and not re.match(r'\s*\||\s*<|#', line):
            lines.append(re.sub(r'^\s*([-*+]|\d+\.|>)\s+', '', line).strip())
    return found


def sentences(text):
    """Each sentence with its line and its words."""
    for line, block in blocks(text):
        block = re.sub(r'`[^`]+`', 'Code', block)
        block = re.sub(r'!?\[([^\]]*)\]\([^)]*\)', r'\1', block)
        for sentence in re.split(r'(?<=[.!?])["\')*]*\s+(?=["\'(*]*[A-Z0-9`])', block):
            words = [word for word in sentence.split() if re.search(r'\w', word)]
            if words:
                yield line, sentence, len(words)


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != '--list']
    paths = [pathlib.Path(a) for a in arguments] or [ROOT / 'README.md', ROOT / 'CONTRIBUTING.md', *sorted((ROOT / 'docs').glob('*.md'))]
    count = long = failed = 0
    for path in paths:
        for line, sentence, words in sentences(path.read_text()):
            count += 1
            long += words > LONG
            fault = f'{words} words' if words > LONGEST else 'opening' if BANNED.match(sentence) else None
            failed += fault is not None
            if fault or words > LONG and '--list' in sys.argv:
                print(f'{path.name}:{line}: {fault or f"{words} words"}: {sentence[:100]}')
    print(f'{count} sentences, {long} of over {LONG} words ({100 * long / max(count, 1):.1f} %), {failed} failed')
    return failed > 0 or long > SHARE * count


if __name__ == '__main__':
    sys.exit(main())
