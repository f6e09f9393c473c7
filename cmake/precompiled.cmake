# The headers of others that most files read are compiled once for each set of flags, not for each file.
set(SLIPCHECK_COMMON_HEADERS
  <Eigen/Core> <Eigen/Geometry> <fmt/format.h> <fmt/ranges.h> <nlohmann/json.hpp> <algorithm> <array> <atomic> <chrono> <cmath>
  <cstdint> <exception> <filesystem> <fstream> <functional> <limits> <map> <memory> <mutex> <numbers> <numeric> <optional>
  <random> <set> <span> <sstream> <stdexcept> <string> <string_view> <thread> <tuple> <type_traits> <utility> <variant>
  <vector>)

function(slipcheck_precompile target)
  get_target_property(type ${target} TYPE)
  if(NOT type MATCHES "LIBRARY|EXECUTABLE" OR type STREQUAL INTERFACE_LIBRARY)
    return()
  endif()
  get_target_property(options ${target} COMPILE_OPTIONS)
  get_target_property(libraries ${target} LINK_LIBRARIES)
  get_target_property(is_plain ${target} SLIPCHECK_PLAIN)
  set(headers ${SLIPCHECK_COMMON_HEADERS})
  if("GTest::gtest_main" IN_LIST libraries)
    list(APPEND headers <gtest/gtest.h>)
  endif()
  list(FILTER libraries INCLUDE REGEX "^slipcheck_(plain|test)_flags$")
  if(NOT options)
    set(options)
  endif()
  # What flags depend on (CMakeLists.txt): with sanitizers on SLIPCHECK_PLAIN, else on the libraries of flags.
  if(SLIPCHECK_SANITIZE)
    set(libraries)
    if(SLIPCHECK_SANITIZE STREQUAL thread)
      set(is_plain OFF)
    endif()
  else()
    set(is_plain OFF)
  endif()
  string(MD5 key "${options} ${libraries} ${is_plain} ${headers}")
  string(SUBSTRING ${key} 0 6 key)
  set(owner slipcheck_headers_${key})
  if(NOT TARGET ${owner})
    set(empty ${PROJECT_BINARY_DIR}/${owner}.cpp)
    file(CONFIGURE OUTPUT ${empty} CONTENT "")
    add_library(${owner} OBJECT EXCLUDE_FROM_ALL ${empty})
    target_link_libraries(${owner} PRIVATE slipcheck_flags ${libraries} Eigen3::Eigen fmt::fmt
      nlohmann_json::nlohmann_json)
    target_compile_options(${owner} PRIVATE ${options})
    set_target_properties(${owner} PROPERTIES SLIPCHECK_PLAIN ${is_plain} CXX_CLANG_TIDY "")
    target_precompile_headers(${owner} PRIVATE ${headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${owner})
  # What the headers were compiled with; a compiler insists on it.
  target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
endfunction()
