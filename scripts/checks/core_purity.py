"""services/*/core is mathematics: no bus, no files, no threads, no clock, no chance of its own.

A core that cannot reach the world gives the same bytes for the same input, and can be tested
with plain numbers. Includes and calls are read from the sources, links from CMake.
"""
import re

from checks.tree import line_of

FORBIDDEN_INCLUDES = re.compile(
    r"lcm/.*|roomwise/.*"
    r"|iostream|ostream|istream|fstream|iomanip|cstdio|stdio\.h|filesystem|syncstream|print"
    r"|thread|mutex|shared_mutex|condition_variable|future|semaphore|latch|barrier|stop_token"
    r"|ctime|time\.h|unistd\.h|sys/.*|fcntl\.h|csignal|signal\.h"
    r"|spdlog/.*|toml\+\+/.*|CLI/.*|zstd\.h"
    r"|opencv2/(?!core|imgproc).*|services/[^/]+/(?!core/).*"
    r"|common/(?!geometry/|image/|create/(?!create_messages)|time\.h$|multiversion\.h$).*")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"\n]+)[>"]', flags=re.M)
FORBIDDEN_CALLS = {
    "reads a clock": re.compile(
        r"::now\s*\(|\bclock_gettime\s*\(|\bgettimeofday\s*\("
        r"|(?<![\w.>])time\s*\(\s*(?:nullptr|NULL|0|&\s*\w+)\s*\)"),
    "reads the environment": re.compile(r"\b(?:secure_)?getenv\s*\("),
    "draws its own random numbers": re.compile(r"\brandom_device\b|(?<![\w.>])s?rand\s*\("),
    "does input or output": re.compile(r"\bstd::(?:cout|cerr|clog|cin)\b|\bf?printf\s*\("),
    "leaves the program": re.compile(r"(?<![\w.>])(?:system|abort|exit|_exit)\s*\("),
}
ALLOWED_LINKS = {"Eigen3::Eigen", "opencv_core", "opencv_imgproc", "common_geometry",
                 "common_image", "common_create", "ZLIB::ZLIB"}  # zlib: for its checksums
COMMAND = re.compile(r"\b(roomwise_library|add_library|target_link_libraries)\s*\(([^()]*)\)")
KEYWORDS = {"SOURCES", "LINKS", "PUBLIC", "PRIVATE", "INTERFACE", "STATIC", "OBJECT", "SHARED"}


def check(tree):
    found = []
    for path in tree.match(r"(services/[^/]+/core|common/create)/(?!create_messages).*\.(h|cpp)"):
        found += check_source(path, tree.text(path), tree.code(path))
    for path in tree.match(r"services/[^/]+/(core/)?CMakeLists\.txt"):
        found += check_links(path, re.sub(r"#[^\n]*", "", tree.text(path)))
    return found


def check_source(path, text, code):
    found = []
    for match in INCLUDE.finditer(text):
        if FORBIDDEN_INCLUDES.fullmatch(match.group(1)):
            found.append(f"{path}:{line_of(text, match.start())}: core must not include "
                         f"{match.group(1)}")
    for deed, pattern in FORBIDDEN_CALLS.items():
        for match in pattern.finditer(code):
            found.append(f"{path}:{line_of(code, match.start())}: core {deed}: {match.group()}")
    return found


def check_links(path, text):
    """A target is a core if its name says so or if it compiles a file of core/."""
    commands = [(match, match.group(2).split()) for match in COMMAND.finditer(text)]
    cores = {words[0] for match, words in commands if match.group(1) != "target_link_libraries"
             and (words[0].endswith("_core") or "/core/" in path
                  or any(word.startswith("core/") for word in words))}
    found = []
    for match, words in commands:
        for library in links_of(match.group(1), words):
            if words[0] in cores and library not in ALLOWED_LINKS:
                found.append(f"{path}:{line_of(text, match.start())}: {words[0]} is a core and "
                             f"must not link {library}")
    return found


def links_of(command, words):
    if command == "target_link_libraries":
        return [word for word in words[1:] if word not in KEYWORDS]
    return words[words.index("LINKS") + 1:] if "LINKS" in words else []
