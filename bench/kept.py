# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors
"""Results that are kept, a file for each machine, and a new one compared with the last of them."""
import json
import os
import re

MOST_GROWTH = 0.10


def path_for(folder, processor, compiler, counter):
    """Instructions can be compared for one processor, compiler and way of counting."""
    words = re.findall(r'[a-z0-9.]+', ' '.join((processor, compiler, counter)).lower())
    return os.path.join(folder, '-'.join(words) + '.json')


def read(path):
    """All kept runs, the oldest first."""
    return json.load(open(path))['runs'] if os.path.exists(path) else []


def keep(path, processor, compiler, counter, run):
    """Adds a run; one of the same commit is replaced."""
    runs = [old for old in read(path) if old['commit'] != run['commit']] + [run]
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, 'w') as file:
        head = json.dumps({'processor': processor, 'compiler': compiler, 'counter': counter})[:-1]
        file.write('%s, "runs": [\n%s\n]}\n' % (head, ',\n'.join(map(json.dumps, runs)))) # a line for each run


def compare(before, now):
    """For each stage of now (stage, instructions before or None, now, remark), and whether any stage takes
    over 10 % more. Only the same work is compared: a stage with another input is as good as new."""
    rows, worse = [], False
    for stage, measured in now.items():
        old = before.get(stage)
        if old is None or old['input'] != measured['input']:
            rows.append((stage, None, measured['instructions'], 'new' if old is None else 'other input'))
            continue
        growth = measured['instructions'] / old['instructions'] - 1
        remark = '**regression**' if growth > MOST_GROWTH else 'better' if growth < -MOST_GROWTH else ''
        worse |= growth > MOST_GROWTH
        rows.append((stage, old['instructions'], measured['instructions'], remark))
    rows += [(stage, old['instructions'], None, 'gone') for stage, old in before.items() if stage not in now]
    return rows, worse


def table_rows(rows, stages):
    """The comparison as words, 10^9 instructions, with seconds and memory of now."""
    for stage, before, now, remark in rows:
        cost = stages.get(stage)
        yield [stage, *('%.3f' % (n / 1e9) if n is not None else '' for n in (before, now)),
               '%+.1f %%' % (100 * (now / before - 1)) if before and now is not None else '', remark,
               *(('%.2f' % cost['cpu_s'], '%d' % cost['memory_mb']) if cost else ('', ''))]
