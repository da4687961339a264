"""Whether what a block of shell calls exists: programs of HL with their options, scripts, presets of CMake."""
import json
import re
import shlex
import subprocess
from functools import lru_cache
from pathlib import Path

HL_PROGRAMS = ("hl", "hld")


def lines_of(text):
    """Command lines without comments, where a line that ends in a backslash goes on in the next."""
    return [shlex.split(line, comments=True) for line in text.replace("\\\n", " ").splitlines()]


def calls_of(text):
    """The simple commands of a block, each a list of words."""
    for words in lines_of(text):
        call = []
        for word in words:
            if word in ("&&", "||", "|", ";"):
                yield call
                call = []
            else:
                call.append(word)
        if call:
            yield call


def options_of(call):
    return {word.split("=")[0] for word in call[1:] if word.startswith("--")}


class Commands:
    def __init__(self, root, programs):
        self.root = Path(root)
        self.programs = programs  # name: path, of hl and hld
        presets = json.loads((self.root / "CMakePresets.json").read_text(encoding="utf-8"))
        self.presets = {preset["name"] for kind in ("configurePresets", "buildPresets", "testPresets")
                        for preset in presets.get(kind, [])}
        self.targets = set(re.findall(r"(?:add_executable|hl_\w+)\((\w+)", "\n".join(
            file.read_text(encoding="utf-8") for file in self.root.glob("*/**/CMakeLists.txt")
            if "build" not in file.relative_to(self.root).parts)))
        self.targets |= {source.stem for source in self.root.glob("examples/[0-9]*.c*")}  # in build/bin/examples

    @lru_cache(maxsize=None)
    def help_of(self, *command):
        done = subprocess.run([*command, "--help"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=60, check=False)
        return done.stdout if done.returncode == 0 else None

    def faults_of_hl(self, name, call):
        command = [self.programs[name]]
        if name == "hl":
            command.append(next((word for word in call[1:] if not word.startswith("-")), ""))
        text = self.help_of(*command)
        if text is None:
            return [f"there is no {' '.join([name, *command[1:]])}"]
        return [f"{name} has no option {option}" for option in options_of(call)
                if not re.search(re.escape(option) + r"\b", text)]

    def faults_of_script(self, call):
        script = self.root / call[0]
        if not script.is_file():
            return [f"there is no {call[0]}"]
        if call[0] == "scripts/run":  # its options are those of hl touch
            return self.faults_of_hl("hl", ["hl", "touch", *call[1:]])
        text = script.read_text(encoding="utf-8")
        return [f"{call[0]} has no option {option}" for option in options_of(call) if option not in text]

    def faults_of_call(self, call):
        name = Path(call[0]).name
        if call[0] in (*HL_PROGRAMS, "build/bin/hl", "build/bin/hld"):
            return self.faults_of_hl(name, call)
        if call[0].startswith(("scripts/", "bench/")):
            return self.faults_of_script(call)
        if call[0].startswith("build/") and name not in self.targets:
            return [f"there is no program {name}"]
        if "--preset" in call and call[call.index("--preset") + 1] not in self.presets:
            return [f"there is no preset {call[call.index('--preset') + 1]}"]
        return []

    def faults_of(self, text):
        return [fault for call in calls_of(text) if call for fault in self.faults_of_call(call)]
