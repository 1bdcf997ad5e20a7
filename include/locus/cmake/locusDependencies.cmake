# SPDX-License-Identifier: LGPL-3.0-or-later
# What the headers need: makes the target locus::dependencies, or leaves the reasons in locus_missing_dependencies.
# Read by CMakeLists.txt and, once installed, by locusConfig.cmake, so that both look in the same way.
#
# CGAL's headers are searched for directly: CGAL's own CMake package adds global settings that locus does not need, and
# its header-only parts used here work without it. A project may use that package next to locus.

set(locus_missing_dependencies "")

find_path(LOCUS_GMP_INCLUDE_DIR gmpxx.h)
find_library(LOCUS_GMP_LIBRARY gmp)
find_library(LOCUS_GMPXX_LIBRARY gmpxx)
find_path(LOCUS_MPFR_INCLUDE_DIR mpfr.h)
find_library(LOCUS_MPFR_LIBRARY mpfr)
find_path(LOCUS_FLINT_INCLUDE_DIR flint/fmpz_poly_factor.h)
find_library(LOCUS_FLINT_LIBRARY flint)
find_path(LOCUS_CGAL_INCLUDE_DIR CGAL/Interval_nt.h)
find_path(LOCUS_BOOST_INCLUDE_DIR boost/config.hpp) # CGAL's headers include Boost's
mark_as_advanced(LOCUS_GMP_INCLUDE_DIR LOCUS_GMP_LIBRARY LOCUS_GMPXX_LIBRARY LOCUS_MPFR_INCLUDE_DIR LOCUS_MPFR_LIBRARY
  LOCUS_FLINT_INCLUDE_DIR LOCUS_FLINT_LIBRARY LOCUS_CGAL_INCLUDE_DIR LOCUS_BOOST_INCLUDE_DIR)

if(NOT LOCUS_GMP_INCLUDE_DIR OR NOT LOCUS_GMP_LIBRARY OR NOT LOCUS_GMPXX_LIBRARY)
  list(APPEND locus_missing_dependencies "GMP with its C++ classes")
endif()
if(NOT LOCUS_MPFR_INCLUDE_DIR OR NOT LOCUS_MPFR_LIBRARY)
  list(APPEND locus_missing_dependencies "MPFR")
endif()
if(NOT LOCUS_FLINT_INCLUDE_DIR OR NOT LOCUS_FLINT_LIBRARY)
  list(APPEND locus_missing_dependencies "FLINT")
endif()
if(NOT LOCUS_CGAL_INCLUDE_DIR)
  list(APPEND locus_missing_dependencies "CGAL's headers")
endif()
if(NOT LOCUS_BOOST_INCLUDE_DIR)
  list(APPEND locus_missing_dependencies "Boost's headers")
endif()
find_package(Threads QUIET)
if(NOT Threads_FOUND)
  list(APPEND locus_missing_dependencies "threads")
endif()

if(NOT locus_missing_dependencies AND NOT TARGET locus::dependencies)
  add_library(locus::dependencies INTERFACE IMPORTED)
  # Imported, so these directories are system directories: no warnings from their headers.
  target_include_directories(locus::dependencies INTERFACE "${LOCUS_GMP_INCLUDE_DIR}" "${LOCUS_MPFR_INCLUDE_DIR}"
    "${LOCUS_FLINT_INCLUDE_DIR}" "${LOCUS_CGAL_INCLUDE_DIR}" "${LOCUS_BOOST_INCLUDE_DIR}")
  target_link_libraries(locus::dependencies INTERFACE "${LOCUS_FLINT_LIBRARY}" "${LOCUS_MPFR_LIBRARY}" "${LOCUS_GMPXX_LIBRARY}"
    "${LOCUS_GMP_LIBRARY}" Threads::Threads)
endif()
