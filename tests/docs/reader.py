"""What a reader of the documents does with a program in them: compiles it against HL."""
import argparse
import subprocess


def parse_arguments(default_compiler):
    parser = argparse.ArgumentParser()
    parser.add_argument("document")
    parser.add_argument("--include", required=True)
    parser.add_argument("--library", required=True)
    parser.add_argument("--compiler", default=default_compiler)
    return parser.parse_args()


def compile_program(program, source, arguments, *flags):
    """Writes `program` to the path `source`, and returns that of the binary beside it."""
    source.write_text(program, encoding="utf-8")
    binary = source.with_suffix("")
    subprocess.run([arguments.compiler, *flags, "-Wall", "-Wextra", "-Werror", str(source), "-o", str(binary),
                    "-I" + arguments.include, "-L" + arguments.library, "-lhl", "-Wl,-rpath," + arguments.library],
                   check=True)
    return binary
