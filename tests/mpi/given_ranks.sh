# How the tests of crease-mpi run it. $1 is crease, $2 crease-mpi; see cli/given.sh.
# shellcheck shell=bash
case "$2" in /*) mpi=$2 ;; *) mpi=$PWD/$2 ;; esac
. "$(dirname "$0")/../cli/given.sh"

# Small machines have fewer processors than ranks; builders are root; sleeping ranks share a core.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
export OMPI_MCA_btl=self,vader OMPI_MCA_orte_base_help_aggregate=0

# ranks N ARGUMENTS...: runs crease-mpi; what it prints is in $printed, the exit code in $got.
ranks() {
    local count=$1
    shift
    printed=$(timeout 600 mpirun -n "$count" "$mpi" "$@" 2>&1 </dev/null)
    got=$?
}

# expect_ranks N CODE "part of what is printed" ARGUMENTS...
expect_ranks() {
    local count=$1 code=$2 part=$3
    shift 3
    checks=$((checks + 1))
    ranks "$count" "$@"
    [ "$got" = "$code" ] || fail "$count ranks, $*: exit $got instead of $code: $printed"
    case "$printed" in
    *"$part"*) ;;
    *) fail "$count ranks, $*: prints '$printed', which lacks '$part'" ;;
    esac
}

# same "what" FILE FILE
same() {
    checks=$((checks + 1))
    cmp "$2" "$3" || fail "$1: $2 and $3 differ"
}
