/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Shapes as the text of CAD files. */
#ifndef CREASE_CAD_FORMAT_HPP
#define CREASE_CAD_FORMAT_HPP

#include <TopoDS_Shape.hxx>

#include <string>

namespace crease_cad
{

enum class Format { STEP, IGES, BREP };

/* The format that the extension stands for. Throws Failure. */
Format format_of(const std::string &path);

/* What the file of that name shall hold: faces in their shells, or, where there are none, edges. */
std::string text_of(const TopoDS_Shape &shape, Format format, const std::string &path);

} // namespace crease_cad

#endif
