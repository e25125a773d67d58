#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Two hosts: network namespaces that see each other through a pair of virtual cards, nothing else.
# Skipped (77) where one may not make them.
. "$(dirname "$0")/given_ranks.sh"

a=creasea$$ b=creaseb$$
skip() {
    echo "skipped: $*"
    exit 77
}
command -v ip >/dev/null || skip "there is no ip to make network namespaces with"
trap 'ip netns del $a; ip netns del $b; rm -rf "$work"' EXIT
ip netns add $a 2>error || skip "network namespaces cannot be made here: $(cat error)"
ip netns add $b && ip link add ca$$ netns $a type veth peer name cb$$ netns $b 2>error ||
    skip "virtual network cards cannot be made here: $(cat error)"
ip -n $a addr add 10.213.77.1/24 dev ca$$ && ip -n $a link set ca$$ up && ip -n $a link set lo up &&
    ip -n $b addr add 10.213.77.2/24 dev cb$$ && ip -n $b link set cb$$ up && ip -n $b link set lo up ||
    skip "virtual network cards cannot be set up here"

# What mpirun calls instead of ssh: HOST COMMAND...
cat >agent <<'END'
#!/bin/sh
host=$1
shift
exec ip netns exec "$host" unshare --uts sh -c "hostname $host; $*"
END
chmod +x agent
export OMPI_MCA_plm_rsh_agent=$PWD/agent OMPI_MCA_btl=self,tcp
export OMPI_MCA_btl_tcp_if_include=10.213.77.0/24 OMPI_MCA_oob_tcp_if_include=10.213.77.0/24
on_hosts() {
    timeout 120 ip netns exec $a unshare --uts sh -c "hostname $a; exec mpirun --host $a:2,$b:2 -n 4 $*"
}

check "there are two hosts" test "$(on_hosts hostname | sort | uniq -c | wc -l)" = 2
expect 0 "" example bracket --count 2500 -o bracket.ply
expect 0 "" detect bracket.ply -o one.ply --creases one.csv
check "four ranks on two hosts" on_hosts "$mpi" detect bracket.ply -o many.ply --creases many.csv -t 1
same "two hosts: points" one.ply many.ply
same "two hosts: creases" one.csv many.csv
finish
