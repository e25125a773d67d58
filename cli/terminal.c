/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "terminal.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

static volatile sig_atomic_t arrived;
static bool drawn;

static void note(int signal_number)
{
    arrived = signal_number;
}

void terminal_catch_signals(void)
{
    struct sigaction action = {.sa_handler = note, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    const int caught[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof caught / sizeof caught[0]; i++)
        sigaction(caught[i], &action, NULL);
    signal(SIGPIPE, SIG_IGN);
}

int terminal_signal(void)
{
    return arrived;
}

void terminal_raise(int signal_number)
{
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

int terminal_cancelled(void *user)
{
    (void)user;
    return arrived != 0;
}

void terminal_warn(void *user, const char *sentence)
{
    (void)user;
    terminal_clear();
    fprintf(stderr, "crease: note: %s\n", sentence);
}

int terminal_columns(void)
{
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        return size.ws_col;
    return 80;
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void draw(const char *stage, double fraction)
{
    char bar[61];
    int width = terminal_columns() - 26;
    width = width > 60 ? 60 : width < 10 ? 10 : width;
    const int full = (int)(fraction * width + 0.5);
    for (int i = 0; i < width; i++)
        bar[i] = i < full ? '#' : '.';
    bar[width] = '\0';
    fprintf(stderr, "\r%-14.14s [%s] %3d %%", stage, bar, (int)(100 * fraction + 0.5));
    fflush(stderr);
    drawn = true;
}

void terminal_progress(void *user, const char *stage, double fraction)
{
    static double begun, last;
    (void)user;
    if (!isatty(STDERR_FILENO))
        return;
    const double time = now();
    if (begun == 0)
        begun = time;
    if (time - begun < 1.0 || (time - last < 0.1 && fraction < 1.0))
        return;
    last = time;
    draw(stage, fraction);
}

void terminal_clear(void)
{
    if (drawn)
        fprintf(stderr, "\r%*s\r", terminal_columns() - 1, "");
    drawn = false;
}
