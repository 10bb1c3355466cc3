"""Nothing tracked may name the machine it was written on: its paths, mirrors or private hosts."""
import re

TRACES = {
    "a path of one machine": re.compile(r"(?<![\w.\-/})])/(?:work|root|home)/"),
    "a package mirror": re.compile(
        r"(?:https?|git|ssh)://[^\s/\"']*\b(?:registry|artifactory|nexus|mirror|proxy)\b"
        r"|(?:https?|git|ssh)://[^\s\"']*/(?:artifactory|nexus)/", flags=re.I),
    "a private host": re.compile(
        r"(?:https?|git|ssh)://(?:[^\s/\"'@]*@)?(?:[\w.\-]+\.(?:internal|intranet|corp|lan)\b"
        r"|10\.\d|172\.(?:1[6-9]|2\d|3[01])\.|192\.168\.)", flags=re.I),
}


def check(tree):
    found = []
    for path in tree.paths:
        for number, line in tree.lines(path):
            found += [f"{path}:{number}: {what}: {match.group()}"
                      for what, pattern in TRACES.items() if (match := pattern.search(line))]
    return found
