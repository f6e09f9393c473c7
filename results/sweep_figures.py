#!/usr/bin/env python3
"""Draws what the stores of scenarios/sweeps hold, and summarises them as CSV and Markdown; results/regenerate calls it.

usage: sweep_figures.py STORES OUT

STORES is the folder of lottery-bullet.db, lottery-engines.db and tuning-bullet.db; of each that is there its figures and its summary are
made in the folder OUT; of one that is not, as its engines are not installed, they stay as they are. Every number in OUT/README.md is computed here.
"""
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402
import slipcheck  # noqa: E402

E_EFF = "i-j.effective_restitution"
E_N = "contacts.0.normal.restitution"
ITERATIONS, ERP, SPLITS = "settings.solver_iterations", "settings.erp2", "settings.splits_at_contacts"
TOLERANCE = 0.005  # of the sweeps' scenes
# No date and no random ids: the same numbers give the same bytes.
plt.rcParams.update({"svg.hashsalt": "slipcheck", "font.size": 9, "axes.titlesize": 9, "figure.dpi": 100})
# Okabe and Ito
INKS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999999"]


def save(figure, path):
    figure.savefig(path, format="svg", metadata={"Date": None, "Creator": "slipcheck"}, bbox_inches="tight")
    plt.close(figure)


def extremes(store):
    """A row for each ensemble: parameters, e_eff in the reference, its least, median and largest over the phases, the worst error."""
    runs = store.runs()
    values = store.table([E_EFF])
    right = values[values.engine == "reference"].set_index(E_N).value if E_N in runs else None
    of_runs = values[values.run.notna()].groupby("run").value
    # A phase in which the balls do not part as they should shows none.
    found = runs.join(of_runs.agg(least="min", median="median", largest="max", seen="count"))
    found["right"] = found[E_N].map(right) if right is not None else values[values.engine == "reference"].value.item()
    found["missing"] = found.phases_seen - found.seen.fillna(0)
    found["error"] = numpy.maximum(found.largest - found.right, found.right - found.least)
    return found


def heat(axes, grid, x, y, title, digits):
    """Errors as colours, a logarithmic scale, with the number in each cell."""
    image = axes.imshow(numpy.log10(numpy.maximum(grid.values, 1e-8)), cmap="viridis_r", vmin=-6, vmax=0, aspect="auto", origin="lower")
    axes.set_xticks(range(len(grid.columns)), [f"{each:g}" for each in grid.columns])
    axes.set_yticks(range(len(grid.index)), [f"{each:g}" for each in grid.index])
    axes.set(xlabel=x, ylabel=y, title=title)
    for row, values in enumerate(grid.values):
        for column, value in enumerate(values):
            axes.text(column, row, f"{value:.{digits}g}" if numpy.isfinite(value) else "–", ha="center", va="center", fontsize=7,
                      color="white" if value > 3e-3 else "black")
    return image


def lottery_bullet(store, out):
    found = extremes(store)
    figure, panels = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for ink, (rate, rows) in zip(INKS, found[found[ITERATIONS] == 10].groupby("rate")):
        rows = rows.sort_values(E_N)
        panels[0].fill_between(rows[E_N], rows.least, rows.largest, color=ink, alpha=0.12, linewidth=0)
        panels[0].plot(rows[E_N], rows["median"], color=ink, marker="o", markersize=3, linewidth=1, label=f"{rate:g} Hz")
    rows = found.drop_duplicates(E_N).sort_values(E_N)
    panels[0].plot(rows[E_N], rows.right, color="black", linestyle="--", label="reference")
    panels[0].set(xlabel="$e_n$", ylabel="$e_{eff}$", title="median and range over the phases, 10 iterations")
    panels[0].legend(fontsize=7)
    at = found[found[E_N] == 0.9].pivot(index=ITERATIONS, columns="rate", values="error")
    heat(panels[1], at, "rate [Hz]", "iterations of the solver", "worst error of $e_{eff}$ at $e_n$ = 0.9", 2)
    save(figure, out / "lottery-bullet.svg")

    spread = found.largest - found.least
    of_rates = found.groupby("rate").error.median()
    within = int((found.error <= TOLERANCE).sum())
    of_iterations = found.groupby(ITERATIONS).error.median()
    apart = int((found.missing > 0).sum())
    return found, [
        "**The lottery, over everything** (`lottery-bullet`, profile `default`, double precision): "
        f"{len(found)} ensembles, {int(found.phases_seen.sum())} runs, e_n from {found[E_N].min():g} to {found[E_N].max():g}, "
        f"{found.rate.min():g} to {found.rate.max():g} Hz, {found[ITERATIONS].min():g} to {found[ITERATIONS].max():g} iterations.",
        f"{within} of {len(found)} ensembles have e_eff within {TOLERANCE:g} in all phases. The worst phase of an ensemble is off by "
        f"{found.error.median():.3g} in the median, by {found.error.max():.3g} at most; one ensemble scatters by up to {spread.max():.3g}. In {apart} ensembles some phases show no e_eff at all.",
        f"The rate does not mend it: the median of the ensembles' worst errors is {of_rates.iloc[0]:.3g} at {of_rates.index[0]:g} Hz and "
        f"{of_rates.iloc[-1]:.3g} at {of_rates.index[-1]:g} Hz. Nor do iterations: it is "
        f"{of_iterations.iloc[0]:.3g} with {of_iterations.index[0]:g} and {of_iterations.iloc[-1]:.3g} with {of_iterations.index[-1]:g}.",
    ]


def name_of(row):
    return f"{row.engine} {row.version}" if row.precision == "double" else f"{row.engine} {row.version} (single)"


def lottery_engines(store, out):
    found = extremes(store)
    found["name"] = [name_of(row) for row in found.itertuples()]
    names = sorted(found.name.unique())
    figure, panels = plt.subplots(1, 2, figsize=(9, 0.32 * len(names) + 1.2), layout="constrained", sharey=True)
    for axes, (profile, rows) in zip(panels, found.groupby("profile")):
        for ink, (e_n, some) in zip(INKS, rows[rows.rate == 240].groupby(E_N)):
            shown = some[some.status == "ok"].set_index("name")
            places = [names.index(name) for name in shown.index]
            axes.hlines(places, shown.least, shown.largest, color=ink, linewidth=3, alpha=0.5)
            axes.plot(shown["median"], places, "o", color=ink, markersize=4, label=f"$e_n$ = {e_n:g}")
            axes.axvline(some.right.iloc[0], color=ink, linestyle="--", linewidth=0.8)
        axes.set_yticks(range(len(names)), names)
        axes.set(xlabel="$e_{eff}$", title=f"{profile}, 240 Hz", xlim=(-1.05, 1.05))
    panels[0].legend(fontsize=7)
    save(figure, out / "lottery-engines.svg")

    lines = [
        f"**Every engine** (`lottery-engines`): {len(found)} ensembles, {int(found.phases_seen.sum())} runs of {len(names)} engines, "
        f"e_n from {found[E_N].min():g} to {found[E_N].max():g}, {found.rate.min():g} to {found.rate.max():g} Hz. Worst error of e_eff over all of "
        f"an engine's ensembles, and how many of them are within {TOLERANCE:g} in every phase:", "",
        "| engine | " + " | ".join(f"{profile}, worst | within" for profile in sorted(found.profile.unique())) + " |",
        "|---|" + "---|---|" * found.profile.nunique()]
    for name in names:
        cells = []
        for _, rows in found[found.name == name].groupby("profile"):
            ok = rows[rows.status == "ok"]
            worst = f"{ok.error.max():.3g}" if ok.error.notna().any() else "none parts"
            if (ok.missing > 0).any() and ok.error.notna().any():
                worst += ", some do not part"
            if len(ok) < len(rows):
                worst += f" ({len(rows) - len(ok)} failed)"
            good = int(((ok.error <= TOLERANCE) & (ok.missing == 0)).sum())
            cells += [worst, f"{good} of {len(rows)}"]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return found, lines


def tuning_bullet(store, out):
    found = extremes(store)
    rates = sorted(found.rate.unique())
    figure, panels = plt.subplots(1, len(rates), figsize=(4.2 * len(rates), 3.2), layout="constrained", sharey=True)
    for axes, rate in zip(panels, rates):
        grid = found[found.rate == rate].pivot(index=SPLITS, columns=ERP, values="error")
        heat(axes, grid, "erp2", "splits_at_contacts" if rate == rates[0] else "", f"{rate:g} Hz", 1)
    save(figure, out / "tuning-bullet.svg")
    lines = [f"**What a search for settings sees** (`tuning-bullet`, about the profile `tuned`): {len(found)} ensembles, "
             f"{int(found.phases_seen.sum())} runs. The worst error of e_eff over the phases of an ensemble:"]
    for rate in rates:
        rows = found[found.rate == rate]
        best, worst = rows.loc[rows.error.idxmin()], rows.loc[rows.error.idxmax()]
        none, most = (rows[rows[SPLITS] == splits].error.median() for splits in (rows[SPLITS].min(), rows[SPLITS].max()))
        lines.append(f"- {rate:g} Hz: median {none:.2g} with splits_at_contacts {rows[SPLITS].min():g}, {most:.2g} with {rows[SPLITS].max():g}; least {best.error:.2g} (splits_at_contacts {best[SPLITS]:g}, erp2 {best[ERP]:g}), largest {worst.error:.2g} "
                     f"({worst[SPLITS]:g}, {worst[ERP]:g}); within {TOLERANCE:g} at {int((rows.error <= TOLERANCE).sum())} of {len(rows)} points.")
    return found, lines


SHOWN = {"lottery-bullet": lottery_bullet, "lottery-engines": lottery_engines, "tuning-bullet": tuning_bullet}


def sections(summary):
    """What a summary made here says of each sweep, as lines by the sweep's name."""
    parts = re.split(r"(?m)^(?=\*\*)", summary.read_text(encoding="utf-8"))[1:] if summary.is_file() else []
    return {re.search(r"\((\S+)\.csv\)", part)[1]: part.rstrip("\n").split("\n") + [""] for part in parts}


def main():
    stores, out = map(Path, sys.argv[1:3])
    out.mkdir(parents=True, exist_ok=True)
    text = ["# Sweeps", "", "What the sweeps of [scenarios/sweeps](../../scenarios/sweeps) have found ([how](../../docs/sweeps.md)): two rolling steel balls that "
            "meet should part with e_eff = (2.5 e_n − 1)/3.5. Made by `results/regenerate`; each ensemble is a row of the CSV beside its figure.", ""]
    kept = sections(out / "README.md")
    for name, show in SHOWN.items():
        if not (stores / f"{name}.db").is_file():
            text += kept.get(name, [])
            continue
        with slipcheck.Store(stores / f"{name}.db") as store:
            if len(store) < store.size:
                sys.exit(f"{stores / name}.db: must hold all runs of the sweep, got {len(store)} of {store.size}")
            found, lines = show(store, out)
            varied = [each for each in store.parameters().name if each in found and found[each].nunique() > 1]
            columns = [*dict.fromkeys(["engine", "version", "precision", "profile", *varied]), "status", "phases_seen", "missing",
                       "right", "least", "median", "largest", "error"]
            found.to_csv(out / f"{name}.csv", columns=columns, float_format="%.9g", lineterminator="\n")
        text += [*lines, "", f"![{name}]({name}.svg)", "", f"[{name}.csv]({name}.csv)", ""]
    (out / "README.md").write_text("\n".join(text), encoding="utf-8")


if __name__ == "__main__":
    main()
