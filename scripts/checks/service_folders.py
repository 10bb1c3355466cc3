"""Every service explains itself and shows where it differs from its defaults."""

NEEDED = ("README.md", "params.toml")


def check(tree):
    services = sorted({path.split("/")[1] for path in tree.match(r"services/[^/]+/.+")})
    return [f"services/{service}:1: has no {name}" for service in services for name in NEEDED
            if f"services/{service}/{name}" not in tree.paths]
