# One place for how the project is compiled.
add_library(crease_flags INTERFACE)
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# No contraction of a * b + c: gcc, clang and every processor give the same bytes. Nobody asks for
# errno or floating-point flags after mathematics, and without them loops with sqrt vectorise.
target_compile_options(crease_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -ffp-contract=off
  -fno-math-errno -fno-trapping-math
  $<$<COMPILE_LANGUAGE:C>:-Wstrict-prototypes -Wmissing-prototypes>)
target_compile_definitions(crease_flags INTERFACE _POSIX_C_SOURCE=200809L)
if(CREASE_WERROR)
  target_compile_options(crease_flags INTERFACE -Werror)
endif()
if(CREASE_SANITIZE STREQUAL "thread")
  # Threads are OpenMP's. gcc's runtime does not tell ThreadSanitizer what waits for what; clang's does through
  # Archer, which comes with it, so that what is reported is a race.
  if(NOT CMAKE_C_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "CREASE_SANITIZE=thread needs clang and its OpenMP: set CMAKE_C_COMPILER and CMAKE_CXX_COMPILER")
  endif()
  target_compile_options(crease_flags INTERFACE -fsanitize=thread -g -O1)
  target_link_options(crease_flags INTERFACE -fsanitize=thread)
elseif(CREASE_SANITIZE)
  target_compile_options(crease_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -g1 -O1)
  target_link_options(crease_flags INTERFACE -fsanitize=address,undefined)
endif()
if(CREASE_FUZZ)
  target_compile_options(crease_flags INTERFACE
    -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -g -O1)
  target_link_options(crease_flags INTERFACE -fsanitize=address,undefined)
endif()
