#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A rank that dies ends the job: no half result, a code that is not 0.
. "$(dirname "$0")/given_ranks.sh"

# rank_of PID: its number in the job.
rank_of() {
    tr '\0' '\n' <"/proc/$1/environ" 2>/dev/null | sed -n 's/^OMPI_COMM_WORLD_RANK=//p'
}

# works PID: whether it has come so far as to catch SIGTERM.
works() {
    local caught
    caught=$(sed -n 's/^SigCgt:[[:space:]]*//p' "/proc/$1/status" 2>/dev/null)
    [ "$(cat "/proc/$1/comm" 2>/dev/null)" = crease-mpi ] && [ $((0x${caught:-0} >> 14 & 1)) = 1 ]
}

# kill_rank N JOB SECONDS: waits until all three ranks of this mpirun are at work, and kills one.
kill_rank() {
    local tries child victim count
    for tries in $(seq 400); do
        count=0
        for child in $(cat "/proc/$2/task/"*/children 2>/dev/null); do
            works "$child" && count=$((count + 1))
            [ "$(rank_of "$child")" = "$1" ] && victim=$child
        done
        if [ $count = 3 ]; then
            sleep "$3"
            kill -KILL "$victim"
            return
        fi
        sleep 0.05
    done
    fail "the ranks have never been at work"
    kill "$2"
}

expect 0 "" example bracket --count 200000 -o bracket.ply
for rank in 1 0; do
    checks=$((checks + 3))
    echo old >edge.ply
    mpirun -n 3 "$mpi" detect bracket.ply -o edge.ply -o new.ply -B 500 -t 1 >log 2>&1 &
    job=$!
    kill_rank $rank $job 0.7
    wait $job
    got=$?
    [ $got != 0 ] || fail "rank $rank was killed, and the job ended with 0: $(cat log)"
    [ "$(cat edge.ply)" = old ] || fail "rank $rank was killed, and the old file is gone"
    [ -z "$(ls -A | grep -vx -e bracket.ply -e edge.ply -e log)" ] || fail "rank $rank left $(ls -A)"
    # mpirun may end the others before they can say it themselves
    [ $rank = 0 ] || check "it is said that a rank has died" grep -q "another rank has died\|exited on signal 9" log
done

# The same where every rank reads its share.
expect 0 "" example bracket --count 120000 -o bracket.ply
checks=$((checks + 3))
mpirun -n 3 "$mpi" detect bracket.ply -o edge.ply -o new.json -B 500 -t 1 --memory 90M >log 2>&1 &
job=$!
kill_rank 2 $job 0.5
wait $job
got=$?
[ $got != 0 ] || fail "rank 2 was killed, and the job ended with 0: $(cat log)"
[ "$(cat edge.ply)" = old ] || fail "rank 2 was killed, and the old file is gone"
[ -z "$(ls -A | grep -vx -e bracket.ply -e edge.ply -e log)" ] || fail "rank 2 left $(ls -A)"

# A rank dies after the scores: the next run goes on from there, with another number of ranks.
expect 0 "" example bracket --count 60000 -o bracket.ply
expect 0 "" detect bracket.ply -o one.ply -B 20 -q
checks=$((checks + 2))
mpirun -n 3 "$mpi" detect bracket.ply -o many.ply -B 20 -t 1 --resume kept >log 2>&1 &
job=$!
for tries in $(seq 1000); do
    [ -e kept/scores.stage ] && break
    sleep 0.02
done
kill_rank 2 $job 0
wait $job && fail "rank 2 was killed, and the job ended with 0: $(cat log)"
[ ! -e many.ply ] || fail "rank 2 was killed, and there is a result"
expect_ranks 2 0 "scores: taken from kept/scores.stage" detect bracket.ply -o many.ply -B 20 --resume kept
same "the resumed run" one.ply many.ply
finish
