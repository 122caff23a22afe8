"""The operators of the mutation campaign (mutants.py): places of a C++ source and their changes.

They use tokens of sources formatted by clang-format: a binary operator has blanks on both sides, `<` of a template has none. A text
that is wrongly regarded as an expression does not compile, and the campaign drops it.

Every mutation replaces a text by another one that contains both the original and the mutant. The number of the mutant, given at the
start of the program, selects one: `on(7)` is true only in mutant 7.
"""
import re
from dataclasses import dataclass

TOKEN = re.compile(r"""
    (?P<space>\s+|//[^\n]*|/\*.*?\*/)
  | (?P<directive>^[ \t]*\#(?:\\\n|[^\n])*)
  | (?P<string>(?:u8|[uUL])?R"(?P<fence>[^(\s]*)\(.*?\)(?P=fence)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+')
  | (?P<number>0[xX][0-9a-fA-F']+\w*|(?:\d[\d']*\.?\d*|\.\d+)(?:[eE][+-]?\d+)?\w*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<sign><=>|->\*|\.\.\.|<<=|>>=|::|->|\+\+|--|<<|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|.)
""", re.VERBOSE | re.DOTALL | re.MULTILINE)

COMPARISONS = {"<": ("<=", ">="), "<=": ("<", ">"), ">": (">=", "<="), ">=": (">", "<"), "==": ("!=",), "!=": ("==",)}
ARITHMETIC = {"+": ("-",), "-": ("+",), "*": ("/",), "/": ("*",)}
LOGIC = {"&&": ("||",), "||": ("&&",)}
ASSIGNMENTS = {"+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
ENDS = {",", ";", "?", ":", "=", "<<", ">>", "%=", "&=", "|=", "^=", "return", "throw", "case", "else", "do", *ASSIGNMENTS}
NO_CALL = set("""return throw break continue using static const auto constexpr if for while switch do case default goto try
    else delete struct class union template typedef static_assert enum public private protected extern inline""".split())
PAIRS = {"(": ")", "[": "]", "{": "}", "<": ">"}
MESSAGES = {"format", "print", "Error", "static_assert", "alignas", "sizeof", "decltype", "say"}


@dataclass
class Token:
    kind: str
    text: str
    start: int
    end: int
    partner: int = -1     # of a bracket
    block: bool = False   # a brace of statements
    inside: int = -1      # the bracket around it


@dataclass
class Mutation:
    kind: str
    start: int
    end: int
    line: int
    text: str      # the original text
    mutant: str    # the text of the mutant
    both: str      # the compiled text, with ON for on(number)


def tokens_of(text):
    tokens = []
    for match in TOKEN.finditer(text):
        if match.lastgroup not in ("space", "directive") and match.group("space") is None and match.group("directive") is None:
            kind = "string" if match.group("string") else "number" if match.group("number") else "name" if match.group("name") else "sign"
            tokens.append(Token(kind, match.group(), match.start(), match.end()))
    return tokens


class Source:
    def __init__(self, text):
        self.text = text
        self.tokens = tokens_of(text)
        self.match_brackets()
        self.inside_function = self.find_functions()

    def blank_before(self, i):
        return i > 0 and self.tokens[i - 1].end < self.tokens[i].start

    def blank_after(self, i):
        return i + 1 < len(self.tokens) and self.tokens[i].end < self.tokens[i + 1].start

    def match_brackets(self):
        stack = []
        for i, token in enumerate(self.tokens):
            token.inside = stack[-1] if stack else -1
            if token.kind != "sign":
                continue
            template = token.text == "<" and not self.blank_before(i) and i > 0 and self.tokens[i - 1].kind == "name"
            if token.text in "([{" or template:
                token.block = token.text == "{" and self.begins_block(i, stack)
                stack.append(i)
            elif token.text in ")]}" or (token.text in (">", ">>") and not self.blank_before(i)):
                while stack and self.tokens[stack[-1]].text == "<" and token.text in ")]}":
                    stack.pop()
                for _ in range(len(token.text)):
                    if stack and PAIRS[self.tokens[stack[-1]].text] == token.text[0]:
                        opener = stack.pop()
                        self.tokens[opener].partner, token.partner = i, opener
                        token.block = self.tokens[opener].block
                        token.inside = self.tokens[opener].inside

    def begins_block(self, i, stack):
        if i == 0:
            return True
        before = self.tokens[i - 1]
        if before.text in (")", "else", "do", "try", "const", "mutable", "noexcept", "]", "override"):
            return True
        if before.text in (";", "}", "{"):
            return not stack or self.tokens[stack[-1]].block
        if before.text == ":":
            return True
        head = [t.text for t in self.head(i)]
        if not stack or self.tokens[stack[-1]].block:
            if head[:1] in (["namespace"], ["struct"], ["class"], ["union"], ["enum"], ["template"], ["extern"]) and "=" not in head:
                return True
        return "->" in head and ")" in head and head.index("->") > 0 and head[head.index("->") - 1] == ")" and before.kind == "name"

    def head(self, i):
        """The tokens before a brace, back to the last end of a statement."""
        k = i - 1
        while k >= 0 and self.tokens[k].text not in (";", "{", "}"):
            k -= 1
        return self.tokens[k + 1:i]

    def find_functions(self):
        """For every token whether it is in the body of a function that is not constexpr."""
        inside, until = [False] * len(self.tokens), -1
        for i, token in enumerate(self.tokens):
            if i <= until:
                inside[i] = True
            elif token.text == "{" and token.partner > 0:
                head = [t.text for t in self.head(i)]
                plain = not ({"namespace", "enum"} & set(head[:2])) and "constexpr" not in head and "consteval" not in head
                if plain and token.block and ")" in head and head[0] not in ("struct", "class", "union"):
                    until = token.partner
        return inside

    def line(self, place):
        return self.text.count("\n", 0, place) + 1

    def left_end(self, i, ends):
        """The first token of the expression that has token i, as far as one of `ends`."""
        k = i - 1
        while k >= 0:
            token = self.tokens[k]
            if token.text in ENDS or token.text in "([{;" or (token.text in ends and self.blank_before(k)):
                break
            if token.text == "<" and token.partner > 0:
                break
            if token.partner >= 0:
                if token.block:
                    break
                opener = self.tokens[token.partner - 1]
                if token.text == ")" and opener.text in ("if", "for", "while", "switch", "constexpr"):
                    break
                k = token.partner
            k -= 1
        return k + 1

    def right_end(self, i, ends):
        k = i + 1
        while k < len(self.tokens):
            token = self.tokens[k]
            if token.text in ENDS or token.text in ")]};" or (token.text in ends and self.blank_before(k) and self.blank_after(k)):
                break
            if token.text == ">" and token.partner >= 0:
                break
            if token.partner > k:
                k = token.partner
            k += 1
        return k - 1

    def piece(self, first, last):
        return self.text[self.tokens[first].start:self.tokens[last].end]

    def in_message(self, i):
        """In a text for people, or in code that only compilers use."""
        k = self.tokens[i].inside
        while k >= 0:
            if self.tokens[k].text == "<" or (self.tokens[k].text in "({" and k > 0 and self.tokens[k - 1].text in MESSAGES):
                return True
            k = self.tokens[k].inside
        return False

    def statement_start(self, i):
        before = self.tokens[i - 1]
        around = self.tokens[i].inside
        if around < 0 or not self.tokens[around].block:
            return False
        if before.text in (";", "else", "do") or (before.text in "{}" and before.block):
            return True
        return before.text == ")" and before.partner > 0 and self.tokens[before.partner - 1].text in ("if", "for", "while")

    def statement_end(self, i):
        k = i
        while k < len(self.tokens) and self.tokens[k].text != ";":
            k = self.tokens[k].partner if self.tokens[k].partner > k else k
            if self.tokens[k].block and self.tokens[k].text == "}" and self.tokens[k].inside == self.tokens[i].inside:
                return -1
            k += 1
        return k if k < len(self.tokens) and self.tokens[k].inside == self.tokens[i].inside else -1

    def is_call(self, i, end):
        """An expression as a statement, no declaration."""
        if self.tokens[i].text in NO_CALL or self.tokens[i].kind == "number":
            return False
        k = i
        while k < end and (self.tokens[k].kind == "name" or self.tokens[k].text in ("::", "<")):
            if self.tokens[k].text == "<":
                if self.tokens[k].partner < 0:
                    return True
                k = self.tokens[k].partner
            elif self.tokens[k].kind == "name" and k > i and self.tokens[k - 1].text != "::":
                return False
            k += 1
        if k == i:
            return True
        if self.tokens[k].text in ("&", "*", "&&") and not self.blank_before(k):
            return False
        return k < end

    def mutations(self):
        """All mutants of this source."""
        for i, token in enumerate(self.tokens):
            if not self.inside_function[i]:
                continue
            if self.statement_start(i):
                yield from self.of_statement(i)
            if self.in_message(i):
                continue
            if token.text in ("if", "while") and self.tokens[i + 1].text == "(":
                yield from self.of_condition(i)
            elif token.kind == "sign" and self.blank_before(i) and self.blank_after(i):
                yield from self.of_operator(i)
            elif token.text == "!" and not self.blank_after(i):
                yield self.make("negation dropped", i, i, "", "::ripstop_mutants::Not{ON} ->* ")
            elif token.kind == "number":
                yield from self.of_number(i)

    def make(self, kind, first, last, mutant, both):
        start, end = self.tokens[first].start, self.tokens[last].end
        return Mutation(kind, start, end, self.line(start), self.text[start:end], mutant, both)

    def of_statement(self, i):
        end = self.statement_end(i)
        if end < 0 or end == i:
            return
        inner, whole = self.piece(i, end - 1), self.piece(i, end)
        if self.tokens[i].text == "return":
            if inner.split() not in (["return"], ["return", "{}"], ["return", "0"], ["return", "false"], ["return", "nullptr"]):
                yield self.make("default returned", i, end, "return {};", f"{{ if (ON) return {{}}; {whole} }}")
        elif self.is_call(i, end):
            if self.tokens[i].text not in MESSAGES:
                yield self.make("statement dropped", i, end, ";", f"{{ if (!ON) {{ {whole} }} }}")
            for k in range(i, end):
                if self.tokens[k].text in ASSIGNMENTS and self.tokens[k].inside == self.tokens[i].inside:
                    other = ASSIGNMENTS[self.tokens[k].text]
                    mutant = self.text[self.tokens[i].start:self.tokens[k].start] + other + self.text[self.tokens[k].end:self.tokens[end].end]
                    yield self.make("arithmetic", i, end, mutant, f"{{ if (ON) {{ {mutant} }} else {{ {whole} }} }}")

    def of_condition(self, i):
        first, last = i + 2, self.tokens[i + 1].partner - 1
        for k in range(first, last):
            if self.tokens[k].text == ";" and self.tokens[k].inside == i + 1:
                first = k + 1
        if last < first or self.tokens[first].text in ("const", "auto"):
            return
        if any(t.text == "=" and t.inside == i + 1 for t in self.tokens[first:last]):
            return
        whole = self.piece(first, last)
        for forced in ("true", "false") if self.tokens[i].text == "if" else ("false",):
            yield self.make("condition forced", first, last, forced, f"(ON ? {forced} : bool({whole}))")

    def of_operator(self, i):
        sign = self.tokens[i].text
        for table, kind, ends in (
                (COMPARISONS, "comparison", {"&&", "||"}),
                (ARITHMETIC, "arithmetic", {"&&", "||", *COMPARISONS, *({"+", "-"} if sign in "*/" else {})}),
                (LOGIC, "logic", {"||"} if sign == "&&" else set())):
            if sign not in table:
                continue
            first, last = self.left_end(i, ends), self.right_end(i, ends)
            if first >= i or last <= i or (kind != "logic" and any(t.kind == "string" for t in self.tokens[first:last + 1])):
                return
            whole = self.piece(first, last)
            for other in table[sign]:
                mutant = self.text[self.tokens[first].start:self.tokens[i].start] + other + self.text[self.tokens[i].end:self.tokens[last].end]
                yield self.make(kind, first, last, mutant, f"(ON ? ({mutant}) : ({whole}))")

    def of_number(self, i):
        text = self.tokens[i].text
        match = re.fullmatch(r"([\d']+)(u|U|l|L|uz|z|ul|UL|ull|ULL)?", text)
        if match:
            value, suffix = int(match.group(1).replace("'", "")), match.group(2) or ""
            others = [f"{value + 1}{suffix}"] + ([f"{value - 1}{suffix}"] if value > 0 else [])
        elif re.fullmatch(r"(\d[\d']*\.?\d*|\.\d+)([eE][+-]?\d+)?[fF]?", text):
            others = ["1.0"] if float(text.rstrip("fF").replace("'", "")) == 0 else [f"(2 * {text})", f"(0 * {text})"]
        else:
            return
        for other in others:
            yield self.make("constant", i, i, other, f"(ON ? {other} : {text})")
