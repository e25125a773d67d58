/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/apart.hpp"

#include "cad/kernel.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace crease_cad
{

const Bounds reading_bounds = {600, "OpenCASCADE comes to no end with it; write the file anew",
    "the content is damaged, OpenCASCADE broke down over it; write the file anew",
    "cancelled before it was read"};

/* What the other process sends before its result. */
struct Verdict {
    crease_status status;
    char sentence[400];
    size_t size; /* of the result */
};

static bool send_all(int pipe, const void *bytes, size_t size)
{
    for (const char *at = (const char *)bytes; size > 0;) {
        const ssize_t sent = write(pipe, at, size);
        if (sent < 0 && errno != EINTR)
            return false;
        at += sent > 0 ? sent : 0;
        size -= sent > 0 ? (size_t)sent : 0;
    }
    return true;
}

static bool receive_all(int pipe, void *bytes, size_t size)
{
    for (char *at = (char *)bytes; size > 0;) {
        const ssize_t got = read(pipe, at, size);
        if (got == 0 || (got < 0 && errno != EINTR))
            return false;
        at += got > 0 ? got : 0;
        size -= got > 0 ? (size_t)got : 0;
    }
    return true;
}

/* Nothing is printed, no core is left, and an interrupt ends this process only. */
static void settle(rlim_t most)
{
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL); /* nobody waits for the result of an orphan */
#endif
    const rlimit none = {0, 0}, seconds = {most, most};
    setrlimit(RLIMIT_CORE, &none);
    setrlimit(RLIMIT_CPU, &seconds);
    for (const int number : {SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU})
        std::signal(number, SIG_DFL);
}

static void work_here(
    int pipe, const std::function<std::vector<char>()> &work, const Bounds &bounds)
{
    settle(bounds.seconds);
    std::vector<char> result;
    Verdict verdict = {};
    if (const std::optional<Failure> failure = failure_of([&] { result = work(); })) {
        verdict.status = failure->status;
        std::snprintf(verdict.sentence, sizeof verdict.sentence, "%s", failure->sentence.c_str());
    }
    verdict.size = result.size();
    if (send_all(pipe, &verdict, sizeof verdict))
        send_all(pipe, result.data(), result.size());
}

/* False when the other process ended before it had sent everything. */
static bool receive(int pipe, Verdict &verdict, std::vector<char> &result)
{
    if (!receive_all(pipe, &verdict, sizeof verdict))
        return false;
    result.resize(verdict.size);
    return receive_all(pipe, result.data(), result.size());
}

static Failure end_of(int status, const Bounds &bounds)
{
    const int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (number == SIGINT || number == SIGTERM)
        return {CREASE_ERROR_CANCELLED, bounds.cancelled};
    if (number == SIGXCPU || number == SIGKILL)
        return {CREASE_ERROR_FORMAT, bounds.endless};
    return {CREASE_ERROR_FORMAT, bounds.broken};
}

std::vector<char> run_apart(const std::function<std::vector<char>()> &work, const Bounds &bounds)
{
    int ends[2];
    if (pipe(ends) != 0)
        throw Failure{CREASE_ERROR_NO_MEMORY, "too many open files; close some"};
    for (const int end : ends)
        fcntl(end, F_SETFD, FD_CLOEXEC);
    const pid_t child = fork();
    if (child == 0) {
        work_here(ends[1], work, bounds);
        _exit(0);
    }
    close(ends[1]);
    Verdict verdict = {};
    std::vector<char> result;
    const bool whole = child > 0 && receive(ends[0], verdict, result);
    close(ends[0]);
    if (child < 0)
        throw Failure{CREASE_ERROR_NO_MEMORY, "no process is to be had; end some others"};
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        continue;
    if (!whole)
        throw end_of(status, bounds);
    if (verdict.status != CREASE_OK)
        throw Failure{verdict.status, verdict.sentence};
    return result;
}

} // namespace crease_cad
