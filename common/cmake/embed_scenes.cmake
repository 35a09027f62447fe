# cmake -P embed_scenes.cmake DIM OUTPUT SCENE...: writes a source file with the
# scenes of a dimension as string literals.
set(dim "${CMAKE_ARGV3}")
set(cpp "// Made by embed_scenes.cmake.
#include \"sem/scene/builtin.h\"

namespace sem {

template <>
const std::vector<BuiltinScene>& builtin_scenes<${dim}>() {
  static const std::vector<BuiltinScene> scenes = {
")
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE 5 ${last})
  set(file "${CMAKE_ARGV${i}}")
  file(READ "${file}" text)
  get_filename_component(name "${file}" NAME_WE)
  if(NOT text MATCHES "\"description\": *\"([^\"\n]+)\"")
    message(FATAL_ERROR "${file}: no \"description\"")
  endif()
  string(APPEND cpp "      {\"${name}\", R\"scene(${CMAKE_MATCH_1})scene\",\n       R\"scene(${text})scene\"},\n")
endforeach()
string(APPEND cpp "  };\n  return scenes;\n}\n\n}  // namespace sem\n")
file(WRITE "${CMAKE_ARGV4}" "${cpp}")
