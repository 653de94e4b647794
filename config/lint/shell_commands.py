"""Which commands a shell script runs, read from its text."""
import re

KEYWORDS = {"if", "then", "elif", "else", "while", "until", "do", "!", "{", "time"}
ENDS = {"fi", "done", "esac", "}"}
BUILTINS = set(". : [ alias bg break builtin cd command continue declare echo eval exec exit export "
               "false fg getopts hash jobs kill let local mapfile popd printf pushd pwd read readarray "
               "readonly return set shift shopt source test times trap true type ulimit umask unalias "
               "unset wait".split())
RUNNERS = set("chroot command env exec flock nice nohup runuser setarch setpriv sudo timeout unshare "
              "xargs".split())
ASSIGNMENT = re.compile(r"[A-Za-z_]\w*(\[[^]]*\])?\+?=")
NAME = re.compile(r"[A-Za-z0-9_][\w.+-]*$|/[\w.+/-]+$")


class ShellCommands:
    """Of one script: `run`, the words where a command stands, and `passed`, the plain words after a
    command that runs another (env; `runners` are more of that kind); both as {word: line}.
    `functions`: its own."""

    def __init__(self, text, runners=()):
        self.run, self.passed, self.functions = {}, {}, set()
        self._text = text
        self._runners = RUNNERS.union(runners)
        self._read(0, len(text))

    def _add(self, words, word, at):
        words.setdefault(word, self._text.count("\n", 0, at) + 1)

    def _quoted(self, at):
        """The end of the double-quoted text that begins before `at`; reads what it substitutes."""
        while self._text[at] != '"':
            if self._text.startswith("$(", at):
                at = self._substituted(at)
            elif self._text.startswith("${", at):
                at = self._parameter(at)
            else:
                at += 2 if self._text[at] == "\\" else 1
        return at + 1

    def _parameter(self, at):
        """The end of the ${...} at `at`."""
        at += 2
        while self._text[at] != "}":
            if self._text.startswith("$(", at):
                at = self._substituted(at)
            elif self._text.startswith("${", at):
                at = self._parameter(at)
            elif self._text[at] == '"':
                at = self._quoted(at + 1)
            else:
                at += 2 if self._text[at] == "\\" else 1
        return at + 1

    def _substituted(self, at):
        """The end of the $(...) or $((...)) at `at`; reads the commands in it."""
        if self._text.startswith("$((", at):
            return self._text.index("))", at) + 2
        return self._read(at + 2, len(self._text), nested=True)

    def _passed(self, at):
        """Behind the character at `at`, or behind the quotes or the substitution that begin there."""
        char = self._text[at]
        if char == "'":
            return self._text.index("'", at + 1) + 1
        if char == '"':
            return self._quoted(at + 1)
        if self._text.startswith("$(", at):
            return self._substituted(at)
        if self._text.startswith("${", at):
            return self._parameter(at)
        return at + (2 if char == "\\" else 1)

    def _word(self, at):
        """The end of the word at `at`, and the word, None if it is more than plain text."""
        begin, plain = at, True
        while at < len(self._text) and self._text[at] not in " \t\n;&|()<>":
            char = self._text[at]
            plain = plain and char not in "'\"$`\\*?~"
            at = self._passed(at)
        return at, self._text[begin:at] if plain else None

    def _array(self, at):
        """The end of the list whose bracket stands before `at`; reads what it substitutes."""
        while self._text[at] != ")":
            if self._text[at] == "#" and self._text[at - 1] in " \t\n":
                at = self._text.index("\n", at)
            elif self._text[at] in " \t\n<>;&|(":
                at += 1
            else:
                at, _ = self._word(at)
        return at + 1

    def _read(self, at, end, nested=False):
        """Reads commands from `at`, with nested to the bracket that closes them. Their end."""
        text, command, target, depth, cases, documents = self._text, True, False, 0, [], []
        runner = False
        while at < end:
            char = text[at]
            if char in " \t":
                at += 1
            elif text.startswith("\\\n", at):
                at += 2
            elif char == "#" and (at == 0 or text[at - 1] in " \t\n;("):
                at = text.find("\n", at) if "\n" in text[at:] else end
            elif char == "\n":
                at, command = at + 1, True
                for document in documents:  # what stands in a here-document is data
                    at = re.compile(rf"^\t*{re.escape(document)}$", re.M).search(text, at).end()
                documents = []
            elif text.startswith("<<", at) and not text.startswith("<<<", at):
                found = re.compile(r"<<-?\s*['\"]?(\w+)['\"]?").match(text, at)
                documents.append(found[1])
                at = found.end()
            elif text.startswith(("<(", ">("), at):
                at, target = self._read(at + 2, end, nested=True), False
            elif char in "<>":
                at, target = at + (3 if text.startswith("<<<", at) else 1), True
                if text[at] in "&>|":
                    at += 1
            elif text.startswith("((", at) and command:
                at, command = text.index("))", at) + 2, False
            elif text.startswith("[[", at) and command:
                at, command = self._condition(at + 2), False
            elif text.startswith(";;", at):
                at, command = at + 2, True
                cases[-1] = "pattern"
            elif char in ";&|":
                at, command = at + 1, True
            elif char == "(":
                at, depth, command = at + 1, depth + 1, True
            elif char == ")":
                at += 1
                if cases and cases[-1] == "pattern":
                    cases[-1], command = "commands", True
                    if text[at - 2] == "(":
                        depth -= 1
                elif depth == 0 and nested:
                    return at
                else:
                    depth, command = depth - 1, False
            else:
                begin = at
                at, word = self._word(at)
                if target:
                    target = False
                elif text[at - 1] == "=" and text.startswith("(", at):
                    at = self._array(at + 1)
                elif cases and cases[-1] == "word":
                    cases[-1] = "pattern" if word == "in" else "word"
                elif cases and cases[-1] == "pattern":
                    if word == "esac":
                        cases.pop()
                elif command and re.match(r"[ \t]*\(\)", text[at:at + 8]):
                    self.functions.add(word)
                    at = text.index(")", at) + 1
                elif command and word == "case":
                    cases.append("word")
                    command = False
                elif command and word == "esac" and cases:
                    cases.pop()
                    command = False
                elif command and (word in KEYWORDS or ASSIGNMENT.match(text, begin)):
                    pass
                elif command and (word is None or word in ENDS or word == "for"):
                    runner = text[begin:at].endswith('[@]}"')  # a list of words: what runs another
                    command = False
                elif word and NAME.match(word):
                    if command:
                        self._add(self.run, word, begin)
                        runner = word in self._runners
                    elif runner:
                        self._add(self.passed, word, begin)
                    command = False
                else:
                    command = False
        return at

    def _condition(self, at):
        """The end of the [[...]] whose brackets stand before `at`."""
        while not self._text.startswith("]]", at):
            at = self._passed(at)
        return at + 2
