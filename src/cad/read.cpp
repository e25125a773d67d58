/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/read.hpp"

#include "cad/kernel.hpp"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <StepData_StepModel.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>

#include <array>
#include <filesystem>
#include <fstream>

namespace crease_cad
{

static Failure not_readable()
{
    return {
        CREASE_ERROR_FORMAT, "OpenCASCADE cannot make sense of the content; write the file anew"};
}

static void require_file(const std::string &path)
{
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found)
        throw Failure{CREASE_ERROR_NO_SUCH_FILE, "there is no such file; check the name"};
    if (std::filesystem::is_directory(status))
        throw Failure{CREASE_ERROR_CANNOT_READ, "this is a directory; give the name of a file"};
    if (!std::ifstream(path))
        throw Failure{CREASE_ERROR_CANNOT_READ, "the file cannot be opened; check its permissions"};
}

static std::string last_line(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    std::string line, last;
    while (std::getline(file, line))
        if (line.find_first_not_of(" \t\r") != std::string::npos)
            last = line;
    return last;
}

/* Every format says where it ends; OpenCASCADE takes half a model for a whole one, or never stops
 * looking for the other half. */
static void require_ending(const std::string &path, bool (*is_ending)(const std::string &line))
{
    if (!is_ending(last_line(path)))
        throw Failure{CREASE_ERROR_TRUNCATED, "the file ends too early; copy it again"};
}

static bool ends_step(const std::string &line)
{
    return line.find("END-ISO-10303-21;") != std::string::npos;
}

static bool ends_iges(const std::string &line)
{
    return line.size() > 72 && line[72] == 'T';
}

/* The whole shape: a sign, its number, the number of its place. */
static bool ends_brep(const std::string &line)
{
    return (line[0] == '+' || line[0] == '-') &&
        line.find_first_not_of("0123456789 \r", 1) == std::string::npos;
}

/* "AP242" and the like where the schema is known, otherwise its own name. */
static std::string short_schema(const std::string &name)
{
    static const std::array<std::pair<const char *, const char *>, 3> known = {
        {{"AP242", "AP242"}, {"AUTOMOTIVE_DESIGN", "AP214"}, {"CONFIG_CONTROL", "AP203"}}};
    for (const auto &[part, brief] : known)
        if (name.find(part) != std::string::npos)
            return brief;
    return name.substr(0, name.find_first_of(" {"));
}

static double step_unit(STEPControl_Reader &reader)
{
    static const std::array<std::pair<const char *, double>, 7> known = {
        {{"millimetre", 1.0}, {"centimetre", 10.0}, {"metre", 1000.0}, {"kilometre", 1e6},
            {"micrometre", 1e-3}, {"inch", 25.4}, {"foot", 304.8}}};
    TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
    reader.FileUnits(lengths, angles, solid_angles);
    if (lengths.IsEmpty())
        return 1.0;
    TCollection_AsciiString name = lengths.First();
    name.LowerCase();
    for (const auto &[word, value] : known)
        if (name.IsEqual(word))
            return value;
    return 1.0;
}

static Model read_step(const std::string &path)
{
    require_ending(path, ends_step);
    STEPControl_Reader reader;
    if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
        throw not_readable();
    Model model;
    const Handle(StepData_StepModel) content = reader.StepModel();
    const APIHeaderSection_MakeHeader header(content);
    if (header.HasFs() && header.NbSchemaIdentifiers() > 0)
        model.schema = short_schema(header.SchemaIdentifiersValue(1)->ToCString());
    model.unit = step_unit(reader);
    reader.TransferRoots();
    model.shape = reader.OneShape();
    return model;
}

static Model read_iges(const std::string &path)
{
    require_ending(path, ends_iges);
    IGESControl_Reader reader;
    if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
        throw not_readable();
    Model model;
    model.unit = reader.IGESModel()->GlobalSection().UnitValue();
    reader.TransferRoots();
    model.shape = reader.OneShape();
    return model;
}

static Model read_brep(const std::string &path)
{
    require_ending(path, ends_brep);
    Model model;
    model.unit = 1.0;
    if (!BRepTools::Read(model.shape, path.c_str(), BRep_Builder()))
        throw not_readable();
    return model;
}

static Model read_as(const std::string &format, const std::string &path)
{
    const Setting unit("xstep.cascade.unit", "MM");
    if (format == "STEP")
        return read_step(path);
    if (format == "IGES")
        return read_iges(path);
    if (format == "BREP")
        return read_brep(path);
    throw Failure{CREASE_ERROR_FORMAT, "this is no CAD file; give a STEP, IGES or BREP file"};
}

Model read_model(const std::string &path)
{
    require_file(path);
    const char *format = crease_file_format(path.c_str());
    try {
        Model model = read_as(format ? format : "", path);
        model.format = format;
        if (model.shape.IsNull())
            throw Failure{CREASE_ERROR_FORMAT, "the file holds no shape; write it anew"};
        return model;
    } catch (const Standard_Failure &) {
        throw not_readable();
    }
}

} // namespace crease_cad
