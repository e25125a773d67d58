/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* STEP, IGES and BREP. Lengths are written as they are and called millimetres, because a cloud does
 * not know its unit. STEP and IGES have 17 digits of every number, so that it reads back as it was
 * (OpenCASCADE gives BREP 15); dates and counters are fixed, so that the same shapes give the same
 * bytes. */
#include "cad/format.hpp"

#include "cad/kernel.hpp"
#include "cad/wireframe.hpp"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepTools.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESData_Protocol.hxx>
#include <IGESSelect_WorkLibrary.hxx>
#include <STEPControl_Writer.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
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

static void set_header(
    const Handle(StepData_StepModel) & model, const std::string &file, const char *content)
{
    APIHeaderSection_MakeHeader header(model);
    header.SetName(text(file));
    header.SetTimeStamp(text(TIME_STAMP));
    header.SetAuthorValue(1, text(""));
    header.SetOrganizationValue(1, text(""));
    header.SetPreprocessorVersion(text(program()));
    header.SetOriginatingSystem(text(program()));
    header.SetAuthorisation(text(""));
    header.SetDescriptionValue(1, text(content));
}

static void print_step(const TopoDS_Shape &shape, const std::string &file, std::ostream &stream)
{
    const Setting schema("write.step.schema", "AP242DIS");
    const Setting unit("write.step.unit", "MM");
    const Setting assembly("write.step.assembly", "Off"); /* several shells are one product */
    STEPControl_Writer writer;
    const bool has_faces = TopExp_Explorer(shape, TopAbs_FACE).More();
    if (!has_faces)
        add_wireframe(shape, writer.Model(true));
    else if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone)
        throw Failure{CREASE_ERROR_NUMERIC, "OpenCASCADE cannot put the faces into a STEP model"};
    const Handle(StepData_StepModel) model = writer.Model();
    set_product_name(model, file.substr(0, file.find_last_of('.')));
    set_header(model, file, has_faces ? "faces" : "curves");
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
 * lose which faces share an edge. Edges on no face are curves (126), which know no vertices. */
static void print_iges(const TopoDS_Shape &shape, const std::string &file, std::ostream &stream)
{
    IGESControl_Writer writer("MM", 1);
    if (!writer.AddShape(shape))
        throw Failure{CREASE_ERROR_NUMERIC, "OpenCASCADE cannot put the shapes into an IGES model"};
    writer.ComputeModel();
    const Handle(IGESData_IGESModel) model = writer.Model();
    set_header(model, file);
    IGESData_IGESWriter printer(model);
    printer.FloatWriter().SetFormat(NUMBER_FORMAT);
    printer.SendModel(IGESSelect_WorkLibrary::DefineProtocol());
    printer.Print(stream);
}

static void print_brep(const TopoDS_Shape &shape, std::ostream &stream)
{
    stream << "DBRep_DrawableShape\n"; /* the mark by which such files are known */
    BRepTools::Write(shape, stream, false, false, TopTools_FormatVersion_VERSION_1);
}

Format format_of(const std::string &path)
{
    static const std::array<std::pair<const char *, Format>, 5> formats = {
        {{".step", Format::STEP}, {".stp", Format::STEP}, {".igs", Format::IGES},
            {".iges", Format::IGES}, {".brep", Format::BREP}}};
    const std::string name = file_name(path);
    std::string extension = name.substr(std::min(name.find_last_of('.'), name.size()));
    std::transform(extension.begin(), extension.end(), extension.begin(),
        [](unsigned char c) { return (char)std::tolower(c); });
    for (const auto &[known, format] : formats)
        if (extension == known)
            return format;
    throw Failure{CREASE_ERROR_ARGUMENT,
        "the name does not tell a CAD format; end it in .step, "
        ".stp, .iges, .igs or .brep"};
}

std::string text_of(const TopoDS_Shape &shape, Format format, const std::string &path)
{
    const std::string file = file_name(path);
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    if (format == Format::STEP)
        print_step(shape, file, stream);
    else if (format == Format::IGES)
        print_iges(shape, file, stream);
    else
        print_brep(shape, stream);
    return stream.str();
}

} // namespace crease_cad
