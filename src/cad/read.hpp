/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Reads CAD files through OpenCASCADE. */
#ifndef CREASE_CAD_READ_HPP
#define CREASE_CAD_READ_HPP

#include <TopoDS_Shape.hxx>

#include <string>

namespace crease_cad
{

struct Model {
    std::string format, schema;
    TopoDS_Shape shape; /* in millimetres */
    double unit;        /* of the file, in millimetres */
};

/* Throws Failure when there is no such file or it is not a CAD file with a shape in it. */
Model read_model(const std::string &path);

} // namespace crease_cad

#endif
