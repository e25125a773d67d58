# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""crease.h, crease_trim.h and crease_cad.h as ctypes: structures, enumerations, functions.

tests/python/test_declarations.py holds them against the headers and against a C compiler.
"""

from __future__ import annotations

from ctypes import (CFUNCTYPE, POINTER, Structure, c_bool, c_char, c_char_p, c_double, c_int,
                    c_int32, c_size_t, c_uint32, c_uint64, c_void_p)
from enum import IntEnum
from typing import Any

#: Major and minor version of the library that these are the declarations of: its soname.
INTERFACE = "0.1"

#: A number that stands for "no face".
NONE = 2**32 - 1

# ---------------------------------------------------------------------------------------- numbers


class Kind(IntEnum):
    """crease_kind."""
    NONE = 0
    USAGE = 1
    INPUT = 2
    FAILURE = 3


class Status(IntEnum):
    """crease_status."""
    OK = 0
    ERROR_ARGUMENT = 1
    ERROR_NO_SUCH_FILE = 2
    ERROR_CANNOT_READ = 3
    ERROR_FORMAT = 4
    ERROR_TRUNCATED = 5
    ERROR_VALUE = 6
    ERROR_TOO_FEW_POINTS = 7
    ERROR_DEGENERATE = 8
    ERROR_CANNOT_WRITE = 9
    ERROR_NO_MEMORY = 10
    ERROR_CANCELLED = 11
    ERROR_NUMERIC = 12
    ERROR_UNSUPPORTED = 13


class Type(IntEnum):
    """crease_type."""
    INT8 = 0
    UINT8 = 1
    INT16 = 2
    UINT16 = 3
    INT32 = 4
    UINT32 = 5
    FLOAT32 = 6
    FLOAT64 = 7


class Detector(IntEnum):
    """crease_detector."""
    BOOTSTRAP = 0
    JACKKNIFE = 1
    VARIATION = 2
    GAUSS_MAP = 3


class RegionType(IntEnum):
    """crease_region_type."""
    PLANE = 0
    SPHERE = 1
    CYLINDER = 2
    CONE = 3
    TORUS = 4
    FREEFORM = 5


class Orientation(IntEnum):
    """crease_orientation."""
    AUTOMATIC = 0
    NONE = 1
    GIVEN = 2


class Side(IntEnum):
    """crease_side."""
    RIGHT = 0
    LEFT = 1


class PartState(IntEnum):
    """crease_part_state."""
    SOLID = 0
    SHELL = 1
    FACES = 2


# ------------------------------------------------------------------------------------- structures

Progress = CFUNCTYPE(None, c_void_p, c_char_p, c_double)
Cancelled = CFUNCTYPE(c_int, c_void_p)
Warn = CFUNCTYPE(None, c_void_p, c_char_p)


class ContextOptions(Structure):
    _fields_ = [("threads", c_int), ("seed", c_uint64), ("memory", c_size_t),
                ("progress", Progress), ("cancelled", Cancelled), ("warn", Warn),
                ("user", c_void_p)]


class Field(Structure):
    _fields_ = [("name", c_char_p), ("type", c_int), ("values", c_void_p)]


class CloudParts(Structure):
    _fields_ = [("count", c_size_t), ("points", c_void_p), ("normals", c_void_p),
                ("fields", POINTER(Field)), ("field_count", c_size_t), ("coordinate_type", c_int)]


class SampleOptions(Structure):
    _fields_ = [("across", c_int), ("along", c_int), ("roof", c_bool), ("spacing", c_double),
                ("shift", c_double), ("noise", c_double), ("moved", c_int), ("variant", c_uint64)]


class PanelOptions(Structure):
    _fields_ = [("count", c_size_t), ("noise", c_double), ("outliers", c_double)]


class BracketOptions(Structure):
    _fields_ = [("count", c_size_t), ("noise", c_double), ("outliers", c_double)]


class ReadOptions(Structure):
    _fields_ = [("skip_invalid", c_bool), ("mesh_points", c_int)]


class FilterOptions(Structure):
    _fields_ = [("neighbours", c_int), ("passes", c_int), ("outlier_sigmas", c_double),
                ("sigma", c_double), ("remove_outliers", c_bool)]


class DetectOptions(Structure):
    _fields_ = [("neighbours", c_int), ("resamples", c_int), ("false_discovery_rate", c_double),
                ("detector", c_int)]


class RegionsOptions(Structure):
    _fields_ = [("sigma", c_double), ("least_points", c_size_t), ("united", c_bool)]


class Region(Structure):
    _fields_ = [("type", c_int), ("parameters", c_double * 8), ("parameter_count", c_size_t),
                ("point_count", c_size_t), ("rms", c_double), ("chi", c_double),
                ("tangent", c_int32 * 2), ("place_error", c_double),
                ("direction_error", c_double), ("radius_error", c_double),
                ("shape_error", c_double)]


class SnapKind(IntEnum):
    PARALLEL = 0
    PERPENDICULAR = 1
    COAXIAL = 2
    EQUAL_RADII = 3
    SYMMETRIC = 4


class Snap(Structure):
    _fields_ = [("kind", c_int), ("region_count", c_size_t), ("regions", POINTER(c_uint32))]


class SurfaceParts(Structure):
    _fields_ = [("order", c_int * 2), ("count", c_size_t * 2), ("knots", c_void_p * 2),
                ("control_points", c_void_p)]


class Foot(Structure):
    _fields_ = [("uv", c_double * 2), ("point", c_double * 3), ("distance", c_double)]


class NetworkCrease(Structure):
    _fields_ = [("regions", c_uint32 * 2), ("corners", c_int32 * 2), ("closed", c_bool),
                ("length", c_double), ("angle", c_double), ("angle_error", c_double),
                ("position_error", c_double)]


class Corner(Structure):
    _fields_ = [("position", c_double * 3), ("valence", c_uint32)]


class Line(Structure):
    _fields_ = [("direction", c_int), ("parameter", c_double), ("angle", c_double),
                ("standard_error", c_double)]


class TrimEdge(Structure):
    _fields_ = [("curve", c_void_p), ("vertices", c_uint32 * 2), ("faces", c_int32 * 2)]


class TrimHalf(Structure):
    _fields_ = [("edge", c_uint32), ("reversed", c_bool)]


class AveragingOptions(Structure):
    _fields_ = [("detect", DetectOptions), ("orientation", c_int), ("rotation", c_double * 9),
                ("net", c_size_t * 2), ("averaging_neighbours", c_int), ("passes", c_int),
                ("marking_neighbours", c_int), ("mark_threshold", c_double),
                ("row_threshold", c_int), ("multiplicity", c_int)]


class SheetOptions(Structure):
    _fields_ = [("orientation", c_int), ("rotation", c_double * 9), ("net", c_size_t * 2),
                ("order", c_int), ("creases", c_int), ("smoothing", c_double),
                ("tolerance", c_double)]


class MeshFoot(Structure):
    _fields_ = [("point", c_double * 3), ("distance", c_double), ("triangle", c_uint32)]


class Fact(Structure):
    _fields_ = [("name", c_char_p), ("text", c_char_p), ("numbers", c_double * 8),
                ("number_count", c_size_t)]


class FigureOptions(Structure):
    _fields_ = [("width", c_int), ("height", c_int), ("azimuth", c_double),
                ("elevation", c_double), ("colour_by", c_char_p), ("axes", c_bool)]


class CadInfo(Structure):
    _fields_ = [("format", c_char * 16), ("schema", c_char * 64),
                *[(name, c_size_t) for name in
                  ("solids", "shells", "closed_shells", "faces", "edges", "vertices", "free_edges",
                   "wire_edges", "sharp_edges", "bspline_faces", "plane_faces", "other_faces")],
                ("valid", c_bool), ("area", c_double), ("volume", c_double),
                ("lowest", c_double * 3), ("highest", c_double * 3), ("tolerance", c_double)]


class CadFace(Structure):
    _fields_ = [("type", c_int), ("area", c_double)]


class PartOptions(Structure):
    _fields_ = [("bspline_faces", c_bool), ("open", c_bool)]


class PartFace(Structure):
    _fields_ = [("region", c_uint32), ("point_count", c_size_t), ("area", c_double),
                ("mean", c_double), ("rms", c_double), ("p95", c_double), ("most", c_double)]


class PartEdge(Structure):
    _fields_ = [("faces", c_uint32 * 2), ("smooth", c_bool), ("length", c_double),
                ("angle", c_double)]


# -------------------------------------------------------------------------------------- functions

#: Objects of the library and arrays of numbers go by their address.
_object = _numbers = c_void_p
_out = POINTER(c_void_p)

#: What each function returns, and what it takes.
FUNCTIONS: dict[str, tuple[Any, ...]] = {
    "crease_status_sentence": (c_char_p, c_int),
    "crease_status_kind": (c_int, c_int),
    "crease_version": (c_char_p,),
    "crease_context_options_default": (ContextOptions,),
    "crease_context_create": (c_int, POINTER(ContextOptions), _out),
    "crease_context_free": (None, _object),
    "crease_context_message": (c_char_p, _object),
    # clouds
    "crease_cloud_create": (c_int, _object, POINTER(CloudParts), _out),
    "crease_cloud_with_fields": (c_int, _object, _object, POINTER(Field), c_size_t, _out),
    "crease_cloud_free": (None, _object),
    "crease_cloud_count": (c_size_t, _object),
    "crease_cloud_points": (_numbers, _object),
    "crease_cloud_normals": (_numbers, _object),
    "crease_cloud_coordinate_type": (c_int, _object),
    "crease_cloud_field_count": (c_size_t, _object),
    "crease_cloud_field": (Field, _object, c_size_t),
    "crease_shape_cube": (c_int, _object, c_int, _out),
    "crease_sample_options_default": (SampleOptions,),
    "crease_shape_sample": (c_int, _object, POINTER(SampleOptions), _out),
    "crease_panel_options_default": (PanelOptions,),
    "crease_shape_panel": (c_int, _object, POINTER(PanelOptions), _out),
    "crease_bracket_options_default": (BracketOptions,),
    "crease_shape_bracket": (c_int, _object, POINTER(BracketOptions), _out),
    "crease_read_options_default": (ReadOptions,),
    "crease_cloud_read": (c_int, _object, c_char_p, POINTER(ReadOptions), _out),
    "crease_cloud_write": (c_int, _object, _object, c_char_p),
    # filter
    "crease_filter_options_default": (FilterOptions,),
    "crease_cloud_filter": (c_int, _object, _object, POINTER(FilterOptions), _out),
    "crease_filtered_free": (None, _object),
    "crease_filtered_cloud": (_object, _object),
    "crease_filtered_outliers": (_numbers, _object),
    "crease_filtered_spacing": (c_double, _object),
    "crease_filtered_sigma": (c_double, _object),
    "crease_filtered_sigma_after": (c_double, _object),
    "crease_filtered_movement": (c_double, _object),
    # scores, regions, creases
    "crease_detect_options_default": (DetectOptions,),
    "crease_scores_compute": (c_int, _object, _object, POINTER(DetectOptions), _out),
    "crease_scores_free": (None, _object),
    "crease_scores_variance": (_numbers, _object),
    "crease_scores_features": (_numbers, _object),
    "crease_regions_options_default": (RegionsOptions,),
    "crease_regions_find": (c_int, _object, _object, POINTER(RegionsOptions), _out),
    "crease_regions_free": (None, _object),
    "crease_regions_count": (c_size_t, _object),
    "crease_regions_labels": (_numbers, _object),
    "crease_regions_normals": (_numbers, _object),
    "crease_regions_spacing": (c_double, _object),
    "crease_regions_sigma": (c_double, _object),
    "crease_regions_at": (Region, _object, c_size_t),
    "crease_regions_snap": (c_int, _object, _object),
    "crease_regions_snap_count": (c_size_t, _object),
    "crease_regions_snap_at": (Snap, _object, c_size_t),
    "crease_network_find": (c_int, _object, _object, c_void_p, _out),
    "crease_network_free": (None, _object),
    "crease_network_count": (c_size_t, _object),
    "crease_network_at": (NetworkCrease, _object, c_size_t),
    "crease_network_curves": (_numbers, _object),
    "crease_network_corner_count": (c_size_t, _object),
    "crease_network_corner": (Corner, _object, c_size_t),
    "crease_network_features": (_numbers, _object),
    "crease_network_spacing": (c_double, _object),
    "crease_network_write": (c_int, _object, _object, c_char_p),
    # curves and surfaces
    "crease_curve_free": (None, _object),
    "crease_curve_order": (c_int, _object),
    "crease_curve_count": (c_size_t, _object),
    "crease_curve_knots": (_numbers, _object),
    "crease_curve_control_points": (_numbers, _object),
    "crease_curve_domain": (None, _object, _numbers),
    "crease_curve_evaluate": (None, _object, c_double, c_int, c_int, _numbers),
    "crease_curves_write": (c_int, _object, _numbers, c_size_t, c_double, c_char_p),
    "crease_surface_parts_of": (SurfaceParts, _object),
    "crease_surface_domain": (None, _object, c_int, _numbers),
    "crease_surface_evaluate": (None, _object, _numbers, _numbers, c_int, _numbers),
    "crease_surface_normal": (None, _object, _numbers, _numbers, _numbers),
    "crease_surface_project": (c_int, _object, _object, _numbers, c_size_t, POINTER(Foot)),
    # sheets
    "crease_averaging_options_default": (AveragingOptions,),
    "crease_averaging_fit": (c_int, _object, _object, POINTER(AveragingOptions), _out),
    "crease_sheet_options_default": (SheetOptions,),
    "crease_sheet_suits": (c_int, _object, _object, POINTER(c_bool)),
    "crease_sheet_fit": (c_int, _object, _object, POINTER(SheetOptions), _out),
    "crease_sheet_carries": (c_int, _object, _object, _object, _object, POINTER(c_bool)),
    "crease_sheet_free": (None, _object),
    "crease_sheet_surface": (_object, _object),
    "crease_sheet_line_count": (c_size_t, _object),
    "crease_sheet_line": (Line, _object, c_size_t),
    "crease_sheet_line_curve": (c_int, _object, _object, c_size_t, _out),
    "crease_sheet_frame": (None, _object, _numbers, _numbers),
    "crease_sheet_point_count": (c_size_t, _object),
    "crease_sheet_parameters": (_numbers, _object),
    "crease_sheet_projected": (_numbers, _object),
    "crease_sheet_deviations": (_numbers, _object),
    "crease_sheet_variance": (_numbers, _object),
    "crease_sheet_standard_errors": (_numbers, _object),
    "crease_sheet_faces": (c_int, _object, _object, _out, POINTER(c_size_t)),
    "crease_surfaces_free": (None, _numbers, c_size_t),
    # meshes
    "crease_mesh_create": (c_int, _object, _numbers, c_size_t, c_double, _out),
    "crease_mesh_free": (None, _object),
    "crease_mesh_vertex_count": (c_size_t, _object),
    "crease_mesh_triangle_count": (c_size_t, _object),
    "crease_mesh_vertices": (_numbers, _object),
    "crease_mesh_normals": (_numbers, _object),
    "crease_mesh_triangles": (_numbers, _object),
    "crease_mesh_owners": (_numbers, _object),
    "crease_mesh_project": (c_int, _object, _object, _numbers, c_size_t, POINTER(MeshFoot)),
    "crease_mesh_write": (c_int, _object, _object, c_char_p),
    # seeing
    "crease_scene_create": (c_int, _object, c_char_p, _out),
    "crease_scene_free": (None, _object),
    "crease_scene_add_cloud": (c_int, _object, _object, c_char_p, _object),
    "crease_scene_add_nets": (c_int, _object, _object, c_char_p, _numbers, c_size_t),
    "crease_scene_add_surfaces": (c_int, _object, _object, c_char_p, _numbers, c_size_t, c_bool),
    "crease_scene_add_mesh": (c_int, _object, _object, c_char_p, _object),
    "crease_scene_add_curves": (c_int, _object, _object, c_char_p, _numbers, c_size_t),
    "crease_scene_describe": (c_int, _object, _object, c_size_t, POINTER(Fact), c_size_t),
    "crease_figure_options_default": (FigureOptions,),
    "crease_figure_write": (c_int, _object, _object, POINTER(FigureOptions), c_char_p),
    "crease_page_write": (c_int, _object, _object, c_char_p),
}

#: Those of crease_trim.h.
TRIM_FUNCTIONS: dict[str, tuple[Any, ...]] = {
    "crease_sheet_trim": (c_int, _object, _object, _out),
    "crease_trim_free": (None, _object),
    "crease_trim_is_whole": (c_bool, _object),
    "crease_trim_edge_at": (TrimEdge, _object, c_size_t),
    "crease_trim_face_count": (c_size_t, _object),
    "crease_trim_loop_count": (c_size_t, _object, c_size_t),
    "crease_trim_loop": (POINTER(TrimHalf), _object, c_size_t, c_size_t, POINTER(c_size_t)),
    "crease_trim_crease_count": (c_size_t, _object),
    "crease_trim_creases": (_numbers, _object),
}

#: Those of crease_cad.h, which a library built without OpenCASCADE lacks.
CAD_FUNCTIONS: dict[str, tuple[Any, ...]] = {
    "crease_cad_trim_write": (c_int, _object, _object, c_char_p),
    "crease_cad_trim_mesh": (c_int, _object, _object, c_double, _out),
    "crease_cad_write": (c_int, _object, _numbers, c_size_t, c_char_p),
    "crease_cad_curves_write": (c_int, _object, _numbers, c_size_t, c_char_p),
    "crease_cad_info_read": (c_int, _object, c_char_p, POINTER(CadInfo)),
    "crease_cad_model_read": (c_int, _object, c_char_p, c_double, _out),
    "crease_cad_model_free": (None, _object),
    "crease_cad_model_mesh": (_object, _object),
    "crease_cad_model_face_count": (c_size_t, _object),
    "crease_cad_model_face": (CadFace, _object, c_size_t),
    "crease_part_options_default": (PartOptions,),
    "crease_part_build": (c_int, _object, _object, _object, _object, POINTER(PartOptions), _out),
    "crease_part_free": (None, _object),
    "crease_part_state_of": (c_int, _object),
    "crease_part_message": (c_char_p, _object),
    "crease_part_solid_count": (c_size_t, _object),
    "crease_part_volume": (c_double, _object),
    "crease_part_regions": (_object, _object),
    "crease_part_unseen_count": (c_size_t, _object),
    "crease_part_face_count": (c_size_t, _object),
    "crease_part_face_at": (PartFace, _object, c_size_t),
    "crease_part_edge_count": (c_size_t, _object),
    "crease_part_edge_at": (PartEdge, _object, c_size_t),
    "crease_part_curves": (_numbers, _object),
    "crease_part_mesh": (_object, _object),
    "crease_part_deviations": (_numbers, _object),
    "crease_part_nearest_faces": (_numbers, _object),
    "crease_part_write": (c_int, _object, _object, c_char_p),
}
