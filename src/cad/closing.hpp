/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Pieces of faces put together: neighbours on one surface united, solids closed. */
#ifndef CREASE_CAD_CLOSING_HPP
#define CREASE_CAD_CLOSING_HPP

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_Shell.hxx>

#include <vector>

namespace crease_cad
{

/* The solid inside oriented faces that bound one: the largest closed shell with the voids in it.
 * Lumps beside it are left out. */
TopoDS_Shape solid_of(const std::vector<TopoDS_Face> &faces);
/* Solids inside closed shells, whichever way their faces are turned: a shell within another one is
 * a void in it, one within a void a solid again. A compound when there are several. */
TopoDS_Shape solids_of(const std::vector<TopoDS_Shell> &shells);
/* A shell of each connected set of faces; a compound when there are several. */
TopoDS_Shape shells_of(const std::vector<TopoDS_Face> &faces);

/* By the faces' orientation; to that relative error, or roughly. */
double volume_of(const TopoDS_Shape &shape, double error = 0.0);
double area_of(const TopoDS_Shape &shape, double error = 0.0);
/* Whether every edge has two faces, or is the seam of one. */
bool is_closed(const TopoDS_Shape &shape);
/* Closed, of positive volume, and without a fault that OpenCASCADE finds. */
bool is_sound(const TopoDS_Shape &shape);

} // namespace crease_cad

#endif
