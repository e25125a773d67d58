/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Work in a process of its own. OpenCASCADE's readers crash, print and run in circles on damaged
 * files; here that ends the other process, and the caller gets a sentence. */
#ifndef CREASE_CAD_APART_HPP
#define CREASE_CAD_APART_HPP

#include <cstddef>
#include <functional>
#include <type_traits>

namespace crease_cad
{

/* Runs the work, which fills the result, apart. Throws what it throws, as Failure. */
void run_apart(void *result, size_t size, const std::function<void()> &work);

/* The same for work that returns a plain structure. */
template <typename Result> Result run_apart(const std::function<Result()> &work)
{
    static_assert(std::is_trivially_copyable_v<Result>);
    Result result = {};
    run_apart(&result, sizeof result, [&] { result = work(); });
    return result;
}

} // namespace crease_cad

#endif
