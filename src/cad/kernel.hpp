/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The border between C and OpenCASCADE: nothing thrown, printed or left changed gets past it. */
#ifndef CREASE_CAD_KERNEL_HPP
#define CREASE_CAD_KERNEL_HPP

#include "crease/crease_cad.h"

#include <Message_SequenceOfPrinters.hxx>
#include <TopoDS_Shape.hxx>

#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace crease_cad
{

constexpr double TURN = 6.283185307179586476925; /* 360 degrees */

/* What our own code throws: the status and the sentence that the caller gets. An empty sentence:
 * the context has one already. */
struct Failure {
    crease_status status;
    std::string sentence;
};

/* Throws when a call of the C library failed; its sentence stays. */
void require(crease_status status);

/* What OpenCASCADE's healing makes of a shape; null where it gives up. */
TopoDS_Shape healed(const TopoDS_Shape &shape);

/* OpenCASCADE's parameters and messages belong to the whole process: whoever holds this has them
 * alone, and its messages go nowhere. */
class Kernel
{
  public:
    Kernel();
    ~Kernel();
    Kernel(const Kernel &) = delete;
    Kernel &operator=(const Kernel &) = delete;

  private:
    std::unique_lock<std::mutex> lock;
    Message_SequenceOfPrinters printers;
};

/* A parameter of OpenCASCADE's translators that gets its old value back at the end of the scope. */
class Setting
{
  public:
    Setting(const char *name, const char *value);
    Setting(const char *name, int value);
    ~Setting();
    Setting(const Setting &) = delete;
    Setting &operator=(const Setting &) = delete;

  private:
    std::string name, before;
};

/* Turns what the work throws into the failure that the caller is told of. */
std::optional<Failure> failure_of(const std::function<void()> &work) noexcept;

/* Runs the work inside the kernel; a failure becomes the status and a sentence that begins with the
 * path. */
crease_status guard(
    crease_context *context, const char *path, const std::function<void()> &work) noexcept;

} // namespace crease_cad

#endif
