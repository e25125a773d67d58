/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* CAD files as triangles. Everything that OpenCASCADE does is done apart, and comes back as bytes:
 * the three counts, then the arrays. */
#include "cad/apart.hpp"
#include "cad/kernel.hpp"
#include "cad/read.hpp"
#include "cad/tessellate.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include <memory>

struct crease_cad_model {
    crease_mesh *mesh;
    std::vector<crease_cad_face> faces;
};

namespace crease_cad
{

static constexpr double AREA_ERROR = 1e-6; /* relative */

static crease_region_type type_of(const TopoDS_Face &face)
{
    switch (BRepAdaptor_Surface(face, false).GetType()) {
    case GeomAbs_Plane:
        return CREASE_REGION_PLANE;
    case GeomAbs_Sphere:
        return CREASE_REGION_SPHERE;
    case GeomAbs_Cylinder:
        return CREASE_REGION_CYLINDER;
    case GeomAbs_Cone:
        return CREASE_REGION_CONE;
    case GeomAbs_Torus:
        return CREASE_REGION_TORUS;
    default:
        return CREASE_REGION_FREEFORM;
    }
}

static std::vector<crease_cad_face> faces_of(const Model &model)
{
    TopTools_IndexedMapOfShape found;
    TopExp::MapShapes(model.shape, TopAbs_FACE, found);
    std::vector<crease_cad_face> faces;
    for (int i = 1; i <= found.Extent(); i++) {
        const TopoDS_Face face = TopoDS::Face(found(i));
        GProp_GProps area;
        BRepGProp::SurfaceProperties(face, area, AREA_ERROR);
        faces.push_back({type_of(face), area.Mass() / (model.unit * model.unit)});
    }
    return faces;
}

static std::vector<char> bytes_of(const std::string &path, double tolerance)
{
    const Model model = read_model(path);
    const std::vector<crease_cad_face> faces = faces_of(model);
    Triangles found = tessellate(model.shape, tolerance * model.unit);
    for (double &coordinate : found.vertices)
        coordinate /= model.unit;
    std::vector<char> bytes;
    const size_t counts[] = {faces.size(), found.vertices.size() / 3, found.triangles.size() / 3};
    append(bytes, counts, 3);
    append(bytes, faces.data(), faces.size());
    append(bytes, found.vertices.data(), found.vertices.size());
    append(bytes, found.triangles.data(), found.triangles.size());
    append(bytes, found.owners.data(), found.owners.size());
    return bytes;
}

static void fill(crease_context *context, const std::vector<char> &bytes, crease_cad_model &model)
{
    const char *from = bytes.data();
    const std::vector<size_t> counts = take<size_t>(from, 3);
    model.faces = take<crease_cad_face>(from, counts[0]);
    const std::vector<double> vertices = take<double>(from, 3 * counts[1]);
    const std::vector<uint32_t> triangles = take<uint32_t>(from, 3 * counts[2]);
    const std::vector<uint32_t> owners = take<uint32_t>(from, counts[2]);
    const crease_mesh_parts parts = {
        counts[1], counts[2], vertices.data(), triangles.data(), owners.data()};
    require(crease_mesh_from_parts(context, &parts, &model.mesh));
}

} // namespace crease_cad

crease_status crease_cad_model_read(
    crease_context *context, const char *path, double tolerance, crease_cad_model **out)
{
    *out = nullptr;
    if (!(tolerance >= 0.0 && tolerance < HUGE_VAL))
        return crease_context_fail(context, CREASE_ERROR_ARGUMENT,
            "%s: a tolerance of %g; give a length, or 0 for a fine one", path, tolerance);
    return crease_cad::guard(context, path, [&] {
        const std::vector<char> bytes =
            crease_cad::run_apart([&] { return crease_cad::bytes_of(path, tolerance); });
        auto model = std::make_unique<crease_cad_model>();
        crease_cad::fill(context, bytes, *model);
        *out = model.release();
    });
}

void crease_cad_model_free(crease_cad_model *model)
{
    if (model)
        crease_mesh_free(model->mesh);
    delete model;
}

const crease_mesh *crease_cad_model_mesh(const crease_cad_model *model)
{
    return model->mesh;
}

size_t crease_cad_model_face_count(const crease_cad_model *model)
{
    return model->faces.size();
}

crease_cad_face crease_cad_model_face(const crease_cad_model *model, size_t index)
{
    return model->faces[index];
}
