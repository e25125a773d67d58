# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors
"""The results as SVG pictures. Needs matplotlib."""
import os

import matplotlib

matplotlib.use('svg')
matplotlib.rcParams.update({'svg.hashsalt': 'crease', 'svg.fonttype': 'path', 'font.size': 9, 'axes.grid': True,
                            'grid.color': '#dddddd', 'axes.spines.top': False, 'axes.spines.right': False,
                            'lines.markersize': 4})
import matplotlib.pyplot as plt

COLORS = ['#c0392b', '#1f6fb2', '#5fa8dc', '#2e8b57', '#8fc79a', '#8e5ea2', '#c9a6d8', '#b8860b']


def picture(path, lines, x, y, logarithmic='', ticks=None, colours=None):
    """lines: {name: (xs, ys)}; the first is ours. logarithmic: which of xy. colours: names in the order of their
    colours, for pictures that have not all of them."""
    figure, axes = plt.subplots(figsize=(6.4, 3.6))
    order = list(dict.fromkeys([*(colours or []), *lines]))
    for number, (name, (xs, ys)) in enumerate(lines.items()):
        axes.plot(xs, ys, 'o-', color=COLORS[order.index(name) % len(COLORS)], linewidth=2 if number == 0 else 1.2,
                  zorder=3 if number == 0 else 2, label=name)
    if 'x' in logarithmic:
        axes.set_xscale('log')
        places = sorted({x for xs, _ in lines.values() for x in xs})
        axes.set_xticks(places, ['{:,}'.format(place).replace(',', '\u202f') for place in places])
        axes.set_xticks([], minor=True)
    if 'y' in logarithmic:
        axes.set_yscale('log')
    else:
        axes.set_ylim(bottom=0)
    if ticks:
        axes.set_xticks(range(len(ticks)), ticks, rotation=30, ha='right')
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.legend(loc='center left', bbox_to_anchor=(1.0, 0.5), frameon=False)
    figure.savefig(path, bbox_inches='tight', metadata={'Date': None})
    plt.close(figure)


def plain(name):
    return name.replace('`', '')


def time_against_points(path, costs, colours=None):
    counts = sorted(costs, key=int)
    names = costs[counts[0]]
    lines = {plain(n): ([int(c) for c in counts], [costs[c][n]['cpu_s'] for c in counts]) for n in names}
    picture(path, lines, 'points', 'CPU seconds', 'xy', colours=colours)


def f1_against_noise(path, means):
    """means: {noise name: {detector: F1}}."""
    noises = sorted(means)
    lines = {plain(n): ([int(noise[1:]) / 100 for noise in noises], [means[noise][n] for noise in noises]) for n in means[noises[0]]}
    picture(path, lines, 'noise, in spacings', 'F1 of edge points, mean')


def fits(path, rows):
    """rows: (points, net, fit, CPU seconds, ...), those of the most points with several nets."""
    rows = [r for r in rows if r[3] is not None]
    nets = lambda points: len({r[1] for r in rows if r[0] == points})
    most = max({r[0] for r in rows}, key=lambda points: (nets(points), points))
    lines = {}
    for name in dict.fromkeys(r[2] for r in rows):
        mine = [r for r in rows if r[2] == name and r[0] == most]
        if mine:
            lines[name] = ([r[1] ** 2 for r in mine], [r[3] for r in mine])
    picture(path, lines, 'control points (%d points)' % most, 'CPU seconds', 'xy')


def error_against_points(path, surfaces):
    """Of bench/noise: errors over the noise, and what least squares without smoothing promise."""
    lines = {}
    for net in dict.fromkeys(s['net'] for s in surfaces if isinstance(s['net'], int)):
        mine = [s for s in surfaces if s['net'] == net]
        lines['%d x %d' % (net, net)] = ([s['points'] / net ** 2 for s in mine], [s['error'] / s['noise'] for s in mine])
    ends = [f(x for xs, _ in lines.values() for x in xs) for f in (min, max)]
    lines['1 / sqrt(points per control point)'] = (ends, [x ** -.5 for x in ends])
    picture(path, lines, 'points for each control point', 'error of the surface / noise', 'xy')


def instructions_over_runs(path, runs):
    """Of each stage, relative to the first kept run that has it with the same input."""
    stages = dict.fromkeys(stage for run in runs for stage in run['stages'])
    lines = {}
    for stage in stages:
        have = [(i, run['stages'][stage]) for i, run in enumerate(runs) if stage in run['stages']]
        have = [(i, s) for i, s in have if s['input'] == have[-1][1]['input']]
        lines[stage] = ([i for i, _ in have], [s['instructions'] / have[0][1]['instructions'] for _, s in have])
    picture(path, lines, '', 'instructions, the first kept run = 1', ticks=[run['commit'] for run in runs])


def draw(folder, run, runs):
    """All pictures for which there are results; their names."""
    drawn = []

    def into(name, function, *given):
        function(os.path.join(folder, name), *given)
        drawn.append(name)
    if run.get('edges'):
        first = run['edges']['f1'][min(run['edges']['f1'])]
        into('bench_time.svg', time_against_points, run['edges']['costs'], [plain(name) for name in first])
        into('bench_noise.svg', f1_against_noise, run['edges']['f1'])
    if run.get('fits'):
        into('bench_fits.svg', fits, run['fits'])
    if runs:
        into('bench_instructions.svg', instructions_over_runs, runs)
    return drawn
