"""A class starts with every number known: in its declaration or in its constructor's list.

The compiler sees the use of a number nobody set only where it sees both ends. Structs without a
trailing underscore are left to it: they are filled by whoever makes them. So are arrays: a scratch
buffer that the next line fills need not be cleared before.
"""
import re

SCALAR = re.compile(
    r"^[ \t]+(?:bool|char|float|double|int|long|(?:std::)?(?:size_t|ptrdiff_t|u?int\d+_t)"
    r"|(?:const )?[\w:<>]+[ \t]*\*)[ \t]+(\w+_);", flags=re.M)


def check(tree):
    found = []
    for path in tree.match(r"(common|services|logs|tests)/.*\.(h|cpp)"):
        code = tree.code(path)
        stem = path.rsplit(".", 1)[0]
        both = "".join(tree.code(p) for p in (f"{stem}.h", f"{stem}.cpp") if p in tree.paths)
        for match in SCALAR.finditer(code):
            if not re.search(rf"[:,][ \t\n]*{match.group(1)}[ \t]*[({{]", both):
                line = code.count("\n", 0, match.start(1)) + 1
                found.append(f"{path}:{line}: {match.group(1)} has no initial value")
    return found
