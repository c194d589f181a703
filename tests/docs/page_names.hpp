#pragma once

/// Names that blocks of code in pages use without declaring them. They stand for the reader's own program.
/// They are only declared, since blocks are compiled and not linked.

#include <Eigen/Geometry>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <graze/graze.hpp>
#include <graze/io/keyframes.hpp>
#include <graze/io/log.hpp>
#include <graze/io/mesh_file.hpp>
#include <graze/io/motion.hpp>
#include <graze/io/picture.hpp>
#include <graze/io/player.hpp>
#include <graze/io/report_json.hpp>
#include <graze/io/scene_file.hpp>
#include <iostream>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

struct Particle {
  float x, y, z, inverse_mass;
};
struct Vertex {
  float u, v, x, y, z;
};

extern graze::Scene scene;
extern graze::SceneSettings settings;
extern graze::ReportHandle report;
extern std::shared_ptr<const graze::Mesh> mesh, cloth_mesh, body_mesh, tool_mesh, tile_mesh;
extern graze::ObjectId id, object, cloth, body, tool, ground;
extern std::vector<graze::ObjectId> ids;
extern std::vector<Eigen::Isometry3d> poses;
extern std::vector<graze::PositionView> views;
extern std::vector<Eigen::Vector3d> positions, points, rest, rest_positions, cloth_positions;
extern std::vector<std::uint32_t> faces_at_the_seam;
extern std::vector<std::uint32_t> inner_walls;
extern std::vector<std::array<std::uint32_t, 3>> triangles;
extern std::vector<std::array<std::uint32_t, 4>> quads;
extern std::vector<Particle> particles;
extern std::vector<Vertex> vertices;
extern Eigen::Isometry3d pose;
extern const float* engine_matrix;
extern bool running;

void simulate(std::vector<Particle>& particles);
void push_apart(graze::ObjectId a, graze::ObjectId b, const Eigen::Vector3d& point_a,
                const Eigen::Vector3d& point_b, const Eigen::Vector3d& normal, double depth);
void hold_off(const Eigen::Vector3d& push, double separation);
void hold_still();
void respond(const graze::PairReport& pair, const graze::Contact& contact);
