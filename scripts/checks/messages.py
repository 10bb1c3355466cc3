"""Reading lcmtypes/*.lcm, with the parser that also generates the C++."""
import functools
import importlib.machinery
import importlib.util
import pathlib
import re


@functools.cache
def generator():
    path = pathlib.Path(__file__).parents[2] / "lcmtypes" / "generate"
    loader = importlib.machinery.SourceFileLoader("lcmtypes_generate", str(path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def message_paths(tree):
    return tree.match(r"lcmtypes/[^/]+\.lcm")


def fields(tree, path):
    """(type, name, [dimension...]) of every member."""
    return generator().parse(tree.root / path)


def field_line(tree, path, name):
    """Line a member is declared on."""
    return next((number for number, line in tree.lines(path)
                 if re.search(rf"\b{name}\s*(\[\w+\])*\s*;", line)), 1)
