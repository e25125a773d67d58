/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/kernel.hpp"

#include <IGESControl_Controller.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>
#include <ShapeFix_Shape.hxx>
#include <Standard_Failure.hxx>
#include <Standard_OutOfMemory.hxx>

#include <exception>
#include <new>

namespace crease_cad
{

static std::mutex kernel_mutex;

void require(crease_status status)
{
    if (status != CREASE_OK)
        throw Failure{status, ""};
}

TopoDS_Shape healed(const TopoDS_Shape &shape)
{
    try {
        ShapeFix_Shape fix(shape);
        fix.Perform();
        return fix.Shape();
    } catch (const Standard_Failure &) {
        return TopoDS_Shape();
    }
}

Kernel::Kernel() : lock(kernel_mutex)
{
    std::swap(printers, Message::DefaultMessenger()->ChangePrinters());
    STEPControl_Controller::Init();
    IGESControl_Controller::Init();
}

Kernel::~Kernel()
{
    std::swap(printers, Message::DefaultMessenger()->ChangePrinters());
}

Setting::Setting(const char *parameter, const char *value)
    : name(parameter), before(Interface_Static::CVal(parameter))
{
    if (!Interface_Static::SetCVal(parameter, value))
        throw Failure{CREASE_ERROR_UNSUPPORTED,
            "OpenCASCADE has no parameter " + name + " of value " + value +
                "; build with OpenCASCADE 7.6"};
}

Setting::Setting(const char *parameter, int value)
    : Setting(parameter, std::to_string(value).c_str())
{
}

Setting::~Setting()
{
    Interface_Static::SetCVal(name.c_str(), before.c_str());
}

std::optional<Failure> failure_of(const std::function<void()> &work) noexcept
{
    try {
        work();
        return std::nullopt;
    } catch (const Failure &failure) {
        return failure;
    } catch (const std::bad_alloc &) {
        return Failure{CREASE_ERROR_NO_MEMORY, "memory ran out; use fewer surfaces"};
    } catch (const Standard_OutOfMemory &) {
        return Failure{CREASE_ERROR_NO_MEMORY, "memory ran out; use fewer surfaces"};
    } catch (const Standard_Failure &failure) {
        return Failure{CREASE_ERROR_NUMERIC,
            std::string("OpenCASCADE gave up (") + failure.DynamicType()->Name() +
                "); check the surfaces for folds and gaps"};
    } catch (const std::exception &failure) {
        return Failure{CREASE_ERROR_NUMERIC,
            std::string("the work failed (") + failure.what() + "); check the surfaces"};
    }
}

crease_status guard(
    crease_context *context, const char *path, const std::function<void()> &work) noexcept
{
    const std::optional<Failure> failure = failure_of([&] {
        const Kernel kernel;
        work();
    });
    if (!failure)
        return CREASE_OK;
    if (failure->sentence.empty())
        return failure->status;
    return crease_context_fail(context, failure->status, "%s: %s", path, failure->sentence.c_str());
}

} // namespace crease_cad
