# The peers whose packages are installed. Their headers are system headers, so that none of the project's warnings look
# into them.

# A peer's file, the libraries it needs and definitions of its own.
function(graze_add_peer name file)
  cmake_parse_arguments(PEER "" "" "LIBRARIES;INCLUDES;DEFINITIONS" ${ARGN})
  target_sources(graze_bench_peers PRIVATE ${file})
  target_compile_definitions(graze_bench_peers PRIVATE GRAZE_BENCH_${name}=1)
  target_include_directories(graze_bench_peers SYSTEM PRIVATE ${PEER_INCLUDES})
  target_link_libraries(graze_bench_peers PRIVATE ${PEER_LIBRARIES})
  set_property(SOURCE ${file} APPEND PROPERTY COMPILE_DEFINITIONS ${PEER_DEFINITIONS})
  message(STATUS "graze_studies bench: ${name} found")
endfunction()

find_package(embree 3 QUIET CONFIG)
if(embree_FOUND)
  graze_add_peer(EMBREE libraries/embree.cpp LIBRARIES embree)
  graze_add_peer(EMBREE_RAYS libraries/embree_rays.cpp LIBRARIES embree)
endif()

find_path(GRAZE_BULLET_INCLUDE BulletCollision/Gimpact/btGImpactBvh.h PATH_SUFFIXES bullet)
find_library(GRAZE_BULLET_COLLISION BulletCollision)
find_library(GRAZE_BULLET_MATH LinearMath)
mark_as_advanced(GRAZE_BULLET_INCLUDE GRAZE_BULLET_COLLISION GRAZE_BULLET_MATH)
if(GRAZE_BULLET_INCLUDE AND GRAZE_BULLET_COLLISION AND GRAZE_BULLET_MATH)
  graze_add_peer(BULLET libraries/bullet.cpp INCLUDES ${GRAZE_BULLET_INCLUDE}
    LIBRARIES ${GRAZE_BULLET_COLLISION} ${GRAZE_BULLET_MATH})
  graze_add_peer(BULLET_RIGID libraries/bullet_rigid_bodies.cpp INCLUDES ${GRAZE_BULLET_INCLUDE}
    LIBRARIES ${GRAZE_BULLET_COLLISION} ${GRAZE_BULLET_MATH})
endif()

find_library(GRAZE_BULLET_SOFT BulletSoftBody)
find_library(GRAZE_BULLET_DYNAMICS BulletDynamics)
mark_as_advanced(GRAZE_BULLET_SOFT GRAZE_BULLET_DYNAMICS)
if(GRAZE_BULLET_INCLUDE AND GRAZE_BULLET_SOFT AND GRAZE_BULLET_DYNAMICS AND GRAZE_BULLET_COLLISION AND GRAZE_BULLET_MATH)
  graze_add_peer(BULLET_SOFT libraries/bullet_soft_bodies.cpp INCLUDES ${GRAZE_BULLET_INCLUDE}
    LIBRARIES ${GRAZE_BULLET_SOFT} ${GRAZE_BULLET_DYNAMICS} ${GRAZE_BULLET_COLLISION} ${GRAZE_BULLET_MATH})
  graze_add_peer(BULLET_SELF libraries/bullet_self_contacts.cpp INCLUDES ${GRAZE_BULLET_INCLUDE}
    LIBRARIES ${GRAZE_BULLET_SOFT} ${GRAZE_BULLET_DYNAMICS} ${GRAZE_BULLET_COLLISION} ${GRAZE_BULLET_MATH})
endif()

find_path(GRAZE_NANOFLANN_INCLUDE nanoflann.hpp)
mark_as_advanced(GRAZE_NANOFLANN_INCLUDE)
if(GRAZE_NANOFLANN_INCLUDE)
  graze_add_peer(NANOFLANN libraries/nanoflann.cpp INCLUDES ${GRAZE_NANOFLANN_INCLUDE})
endif()

# FCL's library is compiled without AVX: Eigen's matrices must be aligned here as they are there.
find_path(GRAZE_FCL_INCLUDE fcl/fcl.h)
find_library(GRAZE_FCL_LIBRARY fcl)
mark_as_advanced(GRAZE_FCL_INCLUDE GRAZE_FCL_LIBRARY)
if(GRAZE_FCL_INCLUDE AND GRAZE_FCL_LIBRARY)
  graze_add_peer(FCL libraries/fcl.cpp INCLUDES ${GRAZE_FCL_INCLUDE} LIBRARIES ${GRAZE_FCL_LIBRARY} Eigen3::Eigen
    DEFINITIONS EIGEN_MAX_ALIGN_BYTES=16)
endif()

find_path(GRAZE_CGAL_INCLUDE CGAL/AABB_tree.h)
find_library(GRAZE_GMP_LIBRARY gmp)
find_library(GRAZE_MPFR_LIBRARY mpfr)
mark_as_advanced(GRAZE_CGAL_INCLUDE GRAZE_GMP_LIBRARY GRAZE_MPFR_LIBRARY)
if(GRAZE_CGAL_INCLUDE AND GRAZE_GMP_LIBRARY AND GRAZE_MPFR_LIBRARY)
  graze_add_peer(CGAL libraries/cgal.cpp INCLUDES ${GRAZE_CGAL_INCLUDE} LIBRARIES ${GRAZE_MPFR_LIBRARY} ${GRAZE_GMP_LIBRARY})
endif()
