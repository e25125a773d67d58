/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Work in a process of its own. OpenCASCADE's readers crash, print and run in circles on damaged
 * files; here that ends the other process, and the caller gets a sentence. */
#ifndef CREASE_CAD_APART_HPP
#define CREASE_CAD_APART_HPP

#include <cstring>
#include <functional>
#include <type_traits>
#include <vector>

namespace crease_cad
{

/* How long the work may take, and what is said when it does not come to its end. */
struct Bounds {
    unsigned seconds; /* of the processor */
    const char *endless, *broken, *cancelled;
};
extern const Bounds reading_bounds;

/* Runs the work apart and returns the bytes that it returns. Throws what it throws, as Failure;
 * where it does not come to its end, a Failure of status FORMAT, or CANCELLED. */
std::vector<char> run_apart(
    const std::function<std::vector<char>()> &work, const Bounds &bounds = reading_bounds);

/* The bytes of plain numbers or structures, one after the other. */
template <typename Item> void append(std::vector<char> &bytes, const Item *items, size_t count)
{
    static_assert(std::is_trivially_copyable_v<Item>);
    const char *const begin = (const char *)items;
    bytes.insert(bytes.end(), begin, begin + count * sizeof *items);
}

/* Takes the next count items from such bytes. */
template <typename Item> std::vector<Item> take(const char *&from, size_t count)
{
    std::vector<Item> items(count);
    if (count)
        std::memcpy((void *)items.data(), from, count * sizeof(Item));
    from += count * sizeof(Item);
    return items;
}

/* Work that returns a plain structure. */
template <typename Result> Result run_apart_for(const std::function<Result()> &work)
{
    Result result = {};
    const std::vector<char> bytes = run_apart([&] {
        std::vector<char> out;
        const Result made = work();
        append(out, &made, 1);
        return out;
    });
    std::memcpy(&result, bytes.data(), sizeof result);
    return result;
}

} // namespace crease_cad

#endif
