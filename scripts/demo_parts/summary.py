"""A drive's figures as a table, as JSON, and its pictures."""
import json
import subprocess

PICTURES = (("landmarks-png", "landmarks.png"), ("labels-png", "labels.png"),
            ("trajectory", "path.txt"))


def number(value):
    return f"{value:.0f}" if value == int(value) else f"{value:.3g}"


def bar(figure):
    limits = [f"at least {number(figure.least)}"] if figure.least is not None else []
    limits += [f"at most {number(figure.most)}"] if figure.most is not None else []
    return " and ".join(limits)


def verdict(figure):
    return "" if not bar(figure) else "held" if figure.held() else "MISSED"


def table(figures):
    lines = [f"{'':34} {'':>9}      {'bar':16}"]
    for figure in figures:
        lines.append(f"{figure.name:34} {number(figure.value):>9} {figure.unit:4} {bar(figure):16}"
                     f" {verdict(figure)}".rstrip())
    return "\n".join(lines)


def write(figures, path):
    as_json = [{"name": f.name, "value": f.value, "unit": f.unit, "least": f.least,
                "most": f.most, "held": f.held()} for f in figures]
    path.write_text(json.dumps({"held": all(f.held() for f in figures), "figures": as_json},
                               indent=1) + "\n")


def draw(rwlog, log, out, title):
    def export(what, name, *options):
        subprocess.run([rwlog, "export", what, log, "-o", out / name, *options], check=True,
                       stdout=subprocess.DEVNULL)
    export("map-png", "map.png", "--title", title)
    for what, name in PICTURES:
        export(what, name)
