/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Work of OpenCASCADE with a limit that is counted, not timed, so that what comes out is the same
 * on every machine. */
#ifndef CREASE_CAD_EFFORT_HPP
#define CREASE_CAD_EFFORT_HPP

#include "cad/kernel.hpp"

#include <Message_ProgressIndicator.hxx>

namespace crease_cad
{

/* Where the work is more than the limit. */
constexpr const char *TOO_MUCH_WORK = "the surfaces have too many intersections";

/* Ends the work once OpenCASCADE has asked so often whether to go on: it asks for every pair of
 * faces, edges and vertices that may meet. A thousand questions take some 0.1 seconds. */
class Effort : public Message_ProgressIndicator
{
  public:
    explicit Effort(long most) : left(most) {}
    /* Throws Failure when the work was ended. */
    void check() const
    {
        if (left < 0)
            throw Failure{CREASE_ERROR_NUMERIC, TOO_MUCH_WORK};
    }

  protected:
    Standard_Boolean UserBreak() override
    {
        return --left < 0;
    }
    void Show(const Message_ProgressScope &, const Standard_Boolean) override {}

  private:
    long left;
};

} // namespace crease_cad

#endif
