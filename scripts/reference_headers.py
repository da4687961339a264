"""What HL's public headers declare, with the comments on it: the content of scripts/reference.

The C headers have /** */ before a declaration and /**< */ behind it, and a line /* ---- Title ---- */ before a section;
hl.hpp has ///.
"""
import re
from dataclasses import dataclass, field

HEADERS = ("hl.h", "hl_types.h", "hl.hpp", "hl_batch.h", "hl_teleop.h")


@dataclass
class Entry:
    names: list
    code: str
    text: str


@dataclass
class Section:
    title: str
    text: str = ""
    entries: list = field(default_factory=list)


@dataclass
class Header:
    name: str
    sections: list


# The pieces of a C header, in the order in which they are tried.
C_PIECE = re.compile(r"""
    /\*\ ----\ (?P<section>[^*]*?)\ -*\ \*/
  | /\*\*(?!<)(?P<comment>.*?)\*/
  | ^(?P<call>HL_API\ [^;]*;|static\ inline\ [^{]*\{)[ ]*(?:/\*\*<(?P<behind>.*?)\*/)?
  | ^(?P<enum>enum\ \{.*?\};)
  | ^(?P<struct>typedef\ struct\ \w+\ \{.*?\}\ \w+;)
  | ^(?P<type>typedef\ [^;{]*;)[ ]*(?:/\*\*<(?P<type_behind>.*?)\*/)?
""", re.VERBOSE | re.DOTALL | re.MULTILINE)
ENUM_MEMBER = re.compile(r"\b(HL_\w+)\s*=")
TITLES = {"hl_types.h": "Types and constants", "hl.hpp": "C++", "hl.h": "Calls", "hl_batch.h": "Batches", "hl_teleop.h": "Teleoperation"}


def words(comment):
    """The text of a comment, without its stars; an empty line parts paragraphs."""
    lines = [re.sub(r"^[ \t]*\*?[ \t]?", "", line).rstrip() for line in comment.strip().splitlines()]
    return re.sub(r"(?<!\n)\n(?!\n)[ ]*", " ", "\n".join(lines)).strip()


def first_comment(source):
    return words(re.match(r"/\*(.*?)\*/", source, re.DOTALL).group(1))


def call_names(code):
    return re.findall(r"\b(hl[A-Z]\w*)\(", code)[:1]


def add_call(section, code, text, behind):
    """A call without a comment of its own, or that says "see" another one, belongs to the one before."""
    code = re.sub(r"^static inline (.*?) \{$", r"\1;", code.removeprefix("HL_API "), flags=re.DOTALL)
    if not text and section.entries and (behind.startswith("see ") or not behind):
        section.entries[-1].names += call_names(code)
        section.entries[-1].code += "\n" + code
    else:
        section.entries.append(Entry(call_names(code), code, text or behind))


def read_c(name, source):
    sections, text = [Section(TITLES[name], first_comment(source))], ""
    for piece in C_PIECE.finditer(source):
        entries = sections[-1].entries
        if piece["section"]:
            sections.append(Section(piece["section"].strip()))
        elif piece["comment"] is not None:
            text = words(piece["comment"])
            continue
        elif piece["call"]:
            add_call(sections[-1], piece["call"], text, words(piece["behind"] or ""))
        elif piece["enum"]:
            entries.append(Entry(ENUM_MEMBER.findall(piece["enum"]), piece["enum"], text))
        elif piece["struct"]:
            entries.append(Entry([re.search(r"struct (\w+)", piece["struct"])[1]], piece["struct"], text))
        elif piece["type"]:
            entries.append(Entry([re.findall(r"\b(HL\w+)\b", piece["type"])[-1 if "(" not in piece["type"] else 0]],
                                 piece["type"], text or words(piece["type_behind"] or "")))
        text = ""
    return Header(name, [section for section in sections if section.entries or section.text])


CPP_NAME = re.compile(r"\b(?:class|struct|concept)\s+(?:\[\[\w+\]\]\s+)?(\w+)|(\w+)\(")


def declaration(lines):
    """The declaration that begins `lines`, up to its body."""
    code = ""
    for line in lines:
        code += line.strip() + "\n"
        if re.search(r";\s*$|\{(?!\})", line):
            break
    # The body, with what a constructor begins with; {} alone is a default.
    return re.sub(r"\s*(?::\s\w+\([^\n]*)?\{(?!\}).*$", "", code.strip(), flags=re.DOTALL)


def members(lines):
    """The data of a struct that begins `lines`, with what is said behind it."""
    body = lines[:next((number for number, line in enumerate(lines) if line.startswith("}")), 0)]
    return "".join(f"\n{line.rstrip()}" for line in body if "///<" in line)


def without_detail(source):
    """A C++ header without what is inside `namespace detail`, and its comment."""
    return re.sub(r"(?:/// Inside[^\n]*\n)?namespace detail \{.*?\}  // namespace detail\n", "", source, flags=re.DOTALL)


def read_cpp(name, source):
    public = without_detail(source)
    lines, entries, owner, hidden, text = public.splitlines(), [], "", False, []
    for number, line in enumerate(lines):
        comment = re.match(r"\s*///(?!<) ?(.*)", line)
        if comment:
            text.append(comment[1])
            continue
        indented = line.startswith(" ")
        hidden = indented and (hidden or line.strip() in ("private:", "protected:"))
        if text and not hidden:
            code = declaration(lines[number:])
            found = CPP_NAME.search(code)
            own = found[1] or found[2]
            owner = owner if indented else own
            data = members(lines[number:]) if "struct" in code else ""
            entries.append(Entry([f"{owner}::{own}" if indented else own], code + data, " ".join(text)))
        text = []
    about = " ".join(re.findall(r"^// ?(.*)", source.split("#pragma")[0], re.MULTILINE))
    return Header(name, [Section(TITLES[name], about, entries)])


def read_headers(folder):
    headers = []
    for name in HEADERS:
        source = (folder / name).read_text(encoding="utf-8")
        headers.append(read_cpp(name, source) if name.endswith(".hpp") else read_c(name, source))
    return headers
