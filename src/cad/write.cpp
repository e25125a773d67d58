/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* STEP, IGES and BREP. Lengths are written as they are and called millimetres, because a cloud does
 * not know its unit. STEP and IGES have 17 digits of every number, so that it reads back as it was
 * (OpenCASCADE gives BREP 15); dates and counters are fixed, so that the same surfaces give the
 * same bytes. */
#include "cad/kernel.hpp"
#include "cad/shell.hpp"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepTools.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESData_Protocol.hxx>
#include <IGESSelect_WorkLibrary.hxx>
#include <STEPControl_Writer.hxx>
#include <ShapeFix_Shape.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <XSControl_WorkSession.hxx>

#include <algorithm>
#include <array>
#include <cctype>
#include <locale>
#include <sstream>

namespace crease_cad
{

static const char *const NUMBER_FORMAT = "%#.17G"; /* reads back as it was; always has a point */
static const char *const TIME_STAMP = "1970-01-01T00:00:00";
static const char *const IGES_DATE = "19700101.000000";

/* Cuts a net at its creases, in both directions, until the pieces are smooth; u-major. */
static void add_smooth_pieces(crease_context *context, const Net &net, size_t surface,
    const Measure &measure, std::vector<Patch> &out)
{
    for (int d = 0; d < 2; d++) {
        const Net turned = d == 0 ? net : transposed(net);
        const std::optional<double> crease = crease_of(turned, measure.fuzz);
        if (!crease)
            continue;
        const auto [lower, upper] = split(context, turned, *crease);
        for (const Net &piece : {lower, upper})
            add_smooth_pieces(context, d == 0 ? piece : transposed(piece), surface, measure, out);
        return;
    }
    if (!collapsed(net, measure.joint))
        out.push_back({straightened(context, net, measure.fuzz), surface});
}

static std::vector<Patch> smooth_patches(
    crease_context *context, const std::vector<Net> &nets, const Measure &measure)
{
    std::vector<Patch> patches;
    for (size_t i = 0; i < nets.size(); i++)
        add_smooth_pieces(context, clamped(context, nets[i]), i, measure, patches);
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
    ShapeFix_Shape fix(shape);
    fix.Perform();
    const TopoDS_Shape fixed = fix.Shape();
    if (!fixed.IsNull() && BRepCheck_Analyzer(fixed).IsValid())
        return fixed;
    throw Failure{CREASE_ERROR_NUMERIC,
        "OpenCASCADE finds fault with " + first_fault(check, shape, patches) +
            ": it folds or cuts itself; nothing was written"};
}

static std::string file_name(const std::string &path)
{
    return path.substr(path.find_last_of('/') + 1);
}

static Handle(TCollection_HAsciiString) text(const std::string &value)
{
    return new TCollection_HAsciiString(value.c_str());
}

static std::string program()
{
    return std::string("crease ") + crease_version();
}

/* OpenCASCADE counts products over the life of the process; the file shall not show that. */
static void set_product_name(const Handle(StepData_StepModel) & model, const std::string &name)
{
    for (int i = 1; i <= model->NbEntities(); i++) {
        const Handle(StepBasic_Product) product =
            Handle(StepBasic_Product)::DownCast(model->Value(i));
        if (product.IsNull())
            continue;
        product->SetId(text(name));
        product->SetName(text(name));
    }
}

static void set_header(const Handle(StepData_StepModel) & model, const std::string &file)
{
    APIHeaderSection_MakeHeader header(model);
    header.SetName(text(file));
    header.SetTimeStamp(text(TIME_STAMP));
    header.SetAuthorValue(1, text(""));
    header.SetOrganizationValue(1, text(""));
    header.SetPreprocessorVersion(text(program()));
    header.SetOriginatingSystem(text(program()));
    header.SetAuthorisation(text(""));
    header.SetDescriptionValue(1, text("B-spline surfaces"));
}

static void print_step(const TopoDS_Shape &shape, const std::string &file, std::ostream &stream)
{
    const Setting schema("write.step.schema", "AP242DIS");
    const Setting unit("write.step.unit", "MM");
    const Setting assembly("write.step.assembly", "Off"); /* several shells are one product */
    STEPControl_Writer writer;
    if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone)
        throw Failure{CREASE_ERROR_NUMERIC, "OpenCASCADE cannot put the faces into a STEP model"};
    const Handle(StepData_StepModel) model = writer.Model();
    set_product_name(model, file.substr(0, file.find_last_of('.')));
    set_header(model, file);
    StepData_StepWriter printer(model);
    printer.FloatWriter().SetFormat(NUMBER_FORMAT);
    printer.SendModel(Handle(StepData_Protocol)::DownCast(writer.WS()->Protocol()));
    printer.Print(stream);
}

static void set_header(const Handle(IGESData_IGESModel) & model, const std::string &file)
{
    IGESData_GlobalSection header = model->GlobalSection();
    header.SetFileName(text(file));
    header.SetSendName(text(file.substr(0, file.find_last_of('.'))));
    header.SetSystemId(text(program()));
    header.SetInterfaceVersion(text(program()));
    header.SetReceiveName(text(""));
    header.SetAuthorName(text(""));
    header.SetCompanyName(text(""));
    header.SetDate(text(IGES_DATE));
    header.SetLastChangeDate(text(IGES_DATE));
    model->SetGlobalSection(header);
}

/* Solids and shells as manifold solid B-reps (186) and shells (514): trimmed surfaces (144) would
 * lose which faces share an edge. */
static void print_iges(const TopoDS_Shape &shape, const std::string &file, std::ostream &stream)
{
    IGESControl_Writer writer("MM", 1);
    if (!writer.AddShape(shape))
        throw Failure{CREASE_ERROR_NUMERIC, "OpenCASCADE cannot put the faces into an IGES model"};
    writer.ComputeModel();
    const Handle(IGESData_IGESModel) model = writer.Model();
    set_header(model, file);
    IGESData_IGESWriter printer(model);
    printer.FloatWriter().SetFormat(NUMBER_FORMAT);
    printer.SendModel(IGESSelect_WorkLibrary::DefineProtocol());
    printer.Print(stream);
}

static void print_brep(const TopoDS_Shape &shape, const std::string &, std::ostream &stream)
{
    stream << "DBRep_DrawableShape\n"; /* the mark by which such files are known */
    BRepTools::Write(shape, stream, false, false, TopTools_FormatVersion_VERSION_1);
}

using Print = void (*)(const TopoDS_Shape &, const std::string &, std::ostream &);

static Print printer_for(const std::string &path)
{
    struct Format {
        const char *extension;
        Print print;
    };
    static const std::array<Format, 5> formats = {{{".step", print_step}, {".stp", print_step},
        {".igs", print_iges}, {".iges", print_iges}, {".brep", print_brep}}};
    const std::string name = file_name(path);
    std::string extension = name.substr(std::min(name.find_last_of('.'), name.size()));
    std::transform(extension.begin(), extension.end(), extension.begin(),
        [](unsigned char c) { return (char)std::tolower(c); });
    for (const Format &format : formats)
        if (extension == format.extension)
            return format.print;
    throw Failure{CREASE_ERROR_ARGUMENT,
        "the name does not tell a CAD format; end it in .step, "
        ".stp, .iges, .igs or .brep"};
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
    const Print print = printer_for(path);
    const std::vector<Net> nets = nets_of(surfaces, count);
    const Measure measure = measure_of(nets);
    const std::vector<Patch> patches = smooth_patches(context, nets, measure);
    const TopoDS_Shape shape = valid_shape(assemble(patches, measure), patches);
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    print(shape, file_name(path), stream);
    return stream.str();
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
