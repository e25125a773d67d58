/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Surfaces as faces. */
#include "cad/format.hpp"
#include "cad/kernel.hpp"
#include "cad/shell.hpp"

#include <BRepCheck_Analyzer.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>

namespace crease_cad
{

static std::vector<Patch> smooth_patches(
    crease_context *context, const std::vector<Net> &nets, const Measure &measure)
{
    std::vector<Patch> patches;
    for (size_t i = 0; i < nets.size(); i++)
        for (Net &piece : smooth_pieces(context, nets[i], measure))
            patches.push_back({std::move(piece), i});
    if (patches.empty())
        throw Failure{CREASE_ERROR_NUMERIC,
            "every surface has shrunk to a curve or a point; "
            "nothing is left to write"};
    return patches;
}

static std::string first_fault(
    const BRepCheck_Analyzer &check, const TopoDS_Shape &shape, const std::vector<Patch> &patches)
{
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    for (int i = 1; i <= faces.Extent(); i++)
        if (!check.IsValid(faces(i)) && (size_t)i <= patches.size())
            return "face " + std::to_string(i) + " (of surface " +
                std::to_string(patches[(size_t)i - 1].surface + 1) + ")";
    return "the shell";
}

static TopoDS_Shape valid_shape(const TopoDS_Shape &shape, const std::vector<Patch> &patches)
{
    const BRepCheck_Analyzer check(shape);
    if (check.IsValid())
        return shape;
    const TopoDS_Shape fixed = healed(shape);
    if (!fixed.IsNull() && BRepCheck_Analyzer(fixed).IsValid())
        return fixed;
    throw Failure{CREASE_ERROR_NUMERIC,
        "OpenCASCADE finds fault with " + first_fault(check, shape, patches) +
            ": it folds or cuts itself; nothing was written"};
}

static std::vector<Net> nets_of(const crease_surface *const *surfaces, size_t count)
{
    if (count == 0)
        throw Failure{CREASE_ERROR_ARGUMENT, "there is no surface to write; give at least one"};
    std::vector<Net> nets;
    for (size_t i = 0; i < count; i++) {
        nets.push_back(net_of(surfaces[i]));
        if (nets[i].degree[0] < 1 || nets[i].degree[1] < 1)
            throw Failure{CREASE_ERROR_ARGUMENT,
                "surface " + std::to_string(i + 1) +
                    " is of order 1, which is no surface to CAD "
                    "programs; use order 2 or more"};
    }
    return nets;
}

static std::string file_content(crease_context *context, const crease_surface *const *surfaces,
    size_t count, const std::string &path)
{
    const Format format = format_of(path);
    const std::vector<Net> nets = nets_of(surfaces, count);
    const Measure measure = measure_of(nets);
    const std::vector<Patch> patches = smooth_patches(context, nets, measure);
    const TopoDS_Shape shape = valid_shape(assemble(patches, measure), patches);
    return text_of(shape, format, path);
}

} // namespace crease_cad

crease_status crease_cad_write(
    crease_context *context, const crease_surface *const *surfaces, size_t count, const char *path)
{
    return crease_cad::guard(context, path, [&] {
        const std::string content = crease_cad::file_content(context, surfaces, count, path);
        crease_cad::require(crease_file_write(context, path, content.data(), content.size()));
    });
}
