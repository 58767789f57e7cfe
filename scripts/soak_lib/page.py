"""A soak as one HTML page without scripts: its outcome, its figures, and a plot of each."""

import html

WIDTH, HEIGHT = 800, 160
STYLE = "body{font:14px sans-serif;max-width:60em;margin:2em}td,th{text-align:right;padding:0 1em}th:first-child,\
td:first-child{text-align:left}svg{border:1px solid #999}polyline{fill:none;stroke:#06c}.failed{color:#b00}"
POINTS = 800  # of a plot at most


def plot(name, samples):
    step = max(1, len(samples) // POINTS)
    chosen = samples[::step]
    most = max((each[name] for each in samples), default=0) or 1
    last_s = samples[-1]["at_s"] or 1 if samples else 1
    points = " ".join(
        f"{each['at_s'] / last_s * WIDTH:.1f},{HEIGHT - each[name] / most * (HEIGHT - 10):.1f}" for each in chosen
    )
    return (
        f"<h3>{html.escape(name)}: at most {most:,}, in {last_s:,.0f} s</h3>"
        f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}"><polyline points="{points}"/></svg>'
    )


def page_of(summary, samples):
    flaws = summary["flaws"]
    rows = "".join(
        f"<tr><td>{html.escape(name)}</td><td>{row['second_quarter']:,}</td><td>{row['last_quarter']:,}</td>"
        f"<td>{row['most']:,}</td></tr>"
        for name, row in summary["figures"].items()
    )
    faults = ", ".join(f"{count} {html.escape(name)}" for name, count in summary["faults"].items())
    outcome = "".join(f'<p class="failed">{html.escape(each)}</p>' for each in flaws) or "<p>Nothing has grown.</p>"
    given = ("seed", "hours", "speed", "personality")
    words = ", ".join(f"{name} {summary[name]}" for name in given if name in summary)
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>godwitd soak</title><style>{STYLE}</style>'
        f"<h1>godwitd soak: {'FAILED' if flaws else 'passed'}</h1><p>{html.escape(words)}</p>{outcome}"
        f"<table><tr><th></th><th>second quarter</th><th>last quarter</th><th>most</th></tr>{rows}</table>"
        f"<p>Faults: {faults}</p>" + "".join(plot(name, samples) for name in summary["figures"]) + "</html>\n"
    )
