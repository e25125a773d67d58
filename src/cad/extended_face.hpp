/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Faces on carriers, beyond their points by a margin. */
#ifndef CREASE_CAD_EXTENDED_FACE_HPP
#define CREASE_CAD_EXTENDED_FACE_HPP

#include "cad/job.hpp"

#include <Geom_Surface.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pnt2d.hxx>

namespace crease_cad
{

struct ExtendedFace {
    TopoDS_Face face;
    Handle(Geom_Surface) surface;
    gp_Ax3 frame;                    /* of a height field, also of one around ... */
    bool round, ball;                /* ... the axis of the frame: angle and height; its centre */
    double origin[2], per_length[2]; /* of a height field: its parameters at the frame's middle, and
                                        what they grow by along x and y */
};

/* Null face when there is nothing to extend. */
ExtendedFace extend(const Job &job, const Carrier &carrier, double margin);

/* Parameters of the surface beside a place. */
gp_Pnt2d foot(const ExtendedFace &extended, const gp_Pnt &place);

/* How far the points of a cylinder or cone reach around its axis, in radians, and the middle of the
 * rest. */
struct Cover {
    double angle, middle_of_gap;
};
Cover cover_of(const Carrier &carrier);

} // namespace crease_cad

#endif
