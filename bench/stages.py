# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors
"""The instructions that each stage takes on one small cloud, on one thread. Unlike seconds they are nearly
the same in every run, whatever else the machine does. Needs numpy and scipy."""
import glob
import os
import re
import subprocess
import zlib

import numpy as np

import clouds
from measuring import ONE_THREAD, run

# Name, program in the build folder, arguments; {x} is a file of that name, made by make_inputs or written.
STAGES = [('neighbours', 'bench/bench-neighbours', 'once 100000 16'),
          ('net', 'bench/bench-fits', '{heights} 128 {values}'),
          ('filter', 'crease', 'filter {roof.ply} -q -o {clean.ply}'),
          ('detect', 'crease', 'detect {bracket.ply} -q -o {edges.ply}'),
          ('fit, sheet', 'crease', 'fit {roof.ply} --method sheet -q -o {sheet.step}'),
          ('fit, part', 'crease', 'fit {bracket.ply} --method part -q -o {part.step}')]
SIZES = {'heights': 100000, 'roof.ply': 2000, 'bracket.ply': 10000}


def make_inputs(folder):
    clouds.roof(SIZES['heights']).tofile(os.path.join(folder, 'heights'))
    for name, points in (('roof.ply', clouds.roof(SIZES['roof.ply'])),
                         ('bracket.ply', clouds.even_points(clouds.bracket()[0], SIZES['bracket.ply'], np.random.default_rng(1)))):
        spacing = np.sqrt(1 / len(points))
        noise = np.random.default_rng(2).normal(size=points.shape) * 0.16 * spacing
        clouds.write_cloud(os.path.join(folder, name), points + noise)


def counter():
    """How instructions are counted here: by the processor where it lets us, else by valgrind, else None."""
    for name, command in (('perf', ['perf', 'stat', '-e', 'instructions:u', 'true']), ('cachegrind', ['valgrind', '--version'])):
        try:
            told = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            if told.returncode == 0 and 'not supported' not in told.stdout and 'not counted' not in told.stdout:
                return name
        except OSError:
            pass
    return None


def count(how, arguments, folder):
    """Instructions of a program and of those that it starts; None when it fails. Under valgrind a forked
    process brings the count of the one it comes from."""
    environment = dict(os.environ, **ONE_THREAD)
    quiet = {'stdout': subprocess.DEVNULL, 'stderr': subprocess.DEVNULL, 'env': environment}
    if how == 'perf':
        path = os.path.join(folder, 'perf')
        if subprocess.run(['perf', 'stat', '-x', ',', '-e', 'instructions:u', '-o', path, *arguments], **quiet).returncode:
            return None
        return sum(int(n) for n in re.findall(r'^(\d+),,instructions', open(path).read(), re.MULTILINE))
    path = os.path.join(folder, 'cachegrind') # half as long as callgrind, the same count
    tool = ['valgrind', '-q', '--tool=cachegrind', '--cache-sim=no', '--trace-children=yes', '--cachegrind-out-file=' + path + '.%p']
    if subprocess.run(tool + arguments, **quiet).returncode:
        return None
    files = glob.glob(path + '.*')
    total = sum(int(n) for file in files for n in re.findall(r'^summary: (\d+)', open(file).read(), re.MULTILINE))
    for file in files:
        os.remove(file)
    return total


def measure(build, folder, tell):
    """{stage: instructions, CPU seconds, MB, checksum of the input}."""
    make_inputs(folder)
    how = counter()
    if how is None:
        raise OSError('neither perf nor valgrind can count instructions here')
    stages = {}
    for name, program, text in STAGES:
        inputs = [os.path.join(folder, file) for file in SIZES if '{' + file + '}' in text]
        words = re.sub(r'{(.*?)}', lambda m: os.path.join(folder, m[1]), text).split()
        arguments = [os.path.join(build, program), *words]
        cost, instructions = run(arguments, **ONE_THREAD), count(how, arguments, folder)
        if cost is None or instructions is None:
            raise OSError(' '.join(arguments) + ' fails')
        checksum = zlib.crc32(text.encode() + b''.join(open(path, 'rb').read() for path in inputs))
        stages[name] = {'instructions': instructions, 'cpu_s': round(cost[0], 3), 'memory_mb': round(cost[1]), 'input': checksum}
        tell('%-12s %8.3f 10^9 instructions, %.2f CPU s, %.0f MB' % (name, instructions / 1e9, *cost))
    return how, stages
