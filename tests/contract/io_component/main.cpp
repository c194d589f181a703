#include <cstdio>
#include <fstream>
#include <graze/io/mesh_file.hpp>

int main() {
  std::ofstream("triangle.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const graze::io::MeshFile file = graze::io::MeshFile::read("triangle.obj");
  const bool good = file.objects().size() == 1 && file.objects()[0].mesh->face_count() == 1;
  std::puts(good ? "read one triangle" : "read something else");
  return good ? 0 : 1;
}
