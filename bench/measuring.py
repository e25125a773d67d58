# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors
"""What the benchmark scripts share: programs that are run and measured, and the machine they run on."""
import glob
import os
import platform
import re
import subprocess
import sys
import tempfile

# A process begins with the peak memory of the one that starts it: so a small one does. Under mpirun
# there is one for each rank.
LAUNCHER = """import os, resource, signal, sys
nowhere = [(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)]
if int(sys.argv[2]):
    resource.setrlimit(resource.RLIMIT_CPU, (int(sys.argv[2]), resource.RLIM_INFINITY))
process = os.posix_spawn(sys.argv[3], sys.argv[3:], os.environ, file_actions=nowhere)
_, status, usage = os.wait4(process, 0)
with open(os.path.join(sys.argv[1], os.environ.get("OMPI_COMM_WORLD_RANK", "0")), "w") as file:
    print(usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, file=file)
sys.exit(status != 0 and not (os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGXCPU))"""
ONE_THREAD = {'OMP_NUM_THREADS': '1', 'OPENBLAS_NUM_THREADS': '1'}


def run_ranks(start, arguments, limit=0, **environment):
    """CPU seconds and peak memory in MB of each process of a program that `start` starts; None when it
    fails. limit: CPU seconds after which a process is ended, which is no failure; 0: none."""
    with tempfile.TemporaryDirectory() as folder:
        command = [*start, sys.executable, '-S', '-c', LAUNCHER, folder, '%d' % limit, *arguments]
        if subprocess.run(command, env=dict(os.environ, **environment)).returncode:
            return None
        texts = [open(os.path.join(folder, str(rank))).read() for rank in range(len(os.listdir(folder)))]
    return [tuple(float(word) for word in text.split()) for text in texts]


def run(arguments, limit=0, **environment):
    """CPU seconds and peak memory in MB of a program, as of run_ranks(); None when it fails."""
    ranks = run_ranks([], arguments, limit, **environment)
    return ranks and ranks[0]


def processor():
    try:
        models = re.findall(r'^model name\s*: *(.*)$', open('/proc/cpuinfo').read(), re.MULTILINE)
    except OSError:
        models = []
    return models[0].strip() if models else platform.machine()


def machine():
    return '%s, %d processors, %s' % (processor(), os.cpu_count(), platform.system())


def compiler(build):
    """Name and version of what compiled the C files of a build folder."""
    for path in glob.glob(os.path.join(build, 'CMakeFiles', '*', 'CMakeCCompiler.cmake')):
        known = dict(re.findall(r'set\(CMAKE_C_COMPILER_(ID|VERSION) "([^"]*)"\)', open(path).read()))
        return '%s %s' % (known.get('ID', ''), known.get('VERSION', ''))
    return ''


def table(titles, rows):
    """Markdown."""
    lines = [titles, ['---'] * len(titles), *rows]
    return ''.join('| %s |\n' % ' | '.join(line) for line in lines)
