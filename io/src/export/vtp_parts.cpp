#include "export/vtp_parts.hpp"

#include "export/snapshot_objects.hpp"
#include "export/vtp_file.hpp"
#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

void check_size(const std::filesystem::path& path, const SceneSnapshot& snapshot) {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  for (const SnapshotObject& object : snapshot.objects) {
    vertices += object.mesh->vertex_count();
    faces += object.mesh->face_count();
  }
  constexpr std::uint64_t limit = std::numeric_limits<std::int32_t>::max();
  if (vertices > limit || 4 * faces > limit)
    fail(path, "the frame has 2^31 vertices or corners, or more; export fewer objects");
}

/// The numbers of the objects of pairs, an entry for each point or cell. -1 stands for an object that the
/// snapshot does not have.
class PairSerials {
 public:
  explicit PairSerials(const SceneSnapshot& snapshot) : objects_(snapshot) {}

  void add(const PairReport& pair) {
    a.push_back(serial_of(pair.a));
    b.push_back(serial_of(pair.b));
  }

  std::vector<std::int64_t> a;
  std::vector<std::int64_t> b;

 private:
  [[nodiscard]] std::int64_t serial_of(ObjectId id) const {
    const SnapshotObject* const object = objects_.find(id);
    return object != nullptr ? static_cast<std::int64_t>(object->serial) : -1;
  }

  SnapshotObjects objects_;
};

/// The columns of the data of contacts.
class ContactPoints {
 public:
  explicit ContactPoints(const SceneSnapshot& snapshot) : serials_(snapshot) {}

  void add(const PairReport& pair, const Contact& contact) {
    file_.add_corner(file_.add_point(contact.point_a));
    file_.end_cell();
    serials_.add(pair);
    for (int axis = 0; axis < 3; ++axis) {
      points_b_.push_back(contact.point_b[axis]);
      normals_.push_back(contact.normal[axis]);
    }
    distances_.push_back(contact.distance);
    kinds_.push_back(static_cast<std::uint8_t>(contact.kind));
    sides_.push_back(static_cast<std::uint8_t>(contact.side_a));
    sides_.push_back(static_cast<std::uint8_t>(contact.side_b));
    sunk_.push_back(contact.sunk ? 1 : 0);
    for (const Feature& feature : {contact.feature_a, contact.feature_b}) {
      feature_kinds_.push_back(static_cast<std::uint8_t>(feature.kind));
      features_.push_back(feature.index);
    }
  }

  void write(const std::filesystem::path& path) {
    file_.set_point_data("object_a", serials_.a);
    file_.set_point_data("object_b", serials_.b);
    file_.set_point_data("kind", kinds_);
    file_.set_point_data("sides", sides_, 2);
    file_.set_point_data("sunk", sunk_);
    file_.set_point_data("feature_kinds", feature_kinds_, 2);
    file_.set_point_data("features", features_, 2);
    file_.set_point_data("point_b", points_b_, 3);
    file_.set_point_data("normal", normals_, 3);
    file_.set_point_data("distance", distances_);
    file_.write(path);
  }

 private:
  VtpFile file_{VtpCells::vertices};
  PairSerials serials_;
  std::vector<double> points_b_;
  std::vector<double> normals_;
  std::vector<double> distances_;
  std::vector<std::uint8_t> kinds_;
  std::vector<std::uint8_t> sides_;
  std::vector<std::uint8_t> sunk_;
  std::vector<std::uint8_t> feature_kinds_;
  std::vector<std::uint32_t> features_;
};

/// The things that lines of a pair show.
enum class VtpLine : std::uint8_t { witness, region_distance, way_out };

/// A line for the witness of each pair, for each of its region distances, and for its way out. A way out is
/// as long as it is thick.
class DistanceLines {
 public:
  explicit DistanceLines(const SceneSnapshot& snapshot) : serials_(snapshot) {}

  void add(const PairReport& pair, const Witness& witness) {
    add(pair, VtpLine::witness, witness.point_a, witness.point_b, pair.distance.upper);
  }
  void add(const PairReport& pair, const RegionDistance& region) {
    add(pair, VtpLine::region_distance, region.point_a, region.point_b, region.distance);
    levels_.back() = region.level;
  }
  void add(const PairReport& pair, const WayOut& way) {
    add(pair, VtpLine::way_out, way.point, way.point + way.thickness * way.direction, way.thickness);
    fullnesses_.back() = way.fullness;
    extents_.back() = way.extent;
  }

  void write(const std::filesystem::path& path) {
    file_.set_cell_data("object_a", serials_.a);
    file_.set_cell_data("object_b", serials_.b);
    file_.set_cell_data("phase", phases_);
    file_.set_cell_data("inside", insides_);
    file_.set_cell_data("distance", distances_);
    file_.set_cell_data("level", levels_);
    file_.set_cell_data("line", lines_);
    file_.set_cell_data("fullness", fullnesses_);
    file_.set_cell_data("extent", extents_);
    file_.write(path);
  }

 private:
  void add(const PairReport& pair, VtpLine line, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
           double length) {
    file_.add_corner(file_.add_point(from));
    file_.add_corner(file_.add_point(to));
    file_.end_cell();
    serials_.add(pair);
    phases_.push_back(static_cast<std::uint8_t>(pair.phase));
    insides_.push_back(static_cast<std::uint8_t>(pair.inside));
    distances_.push_back(length);
    levels_.push_back(0);
    lines_.push_back(static_cast<std::uint8_t>(line));
    fullnesses_.push_back(0);
    extents_.push_back(0);
  }

  VtpFile file_{VtpCells::lines};
  PairSerials serials_;
  std::vector<std::uint8_t> phases_;
  std::vector<std::uint8_t> insides_;
  std::vector<double> distances_;
  std::vector<std::uint32_t> levels_;
  std::vector<std::uint8_t> lines_;
  std::vector<double> fullnesses_;
  std::vector<double> extents_;
};

}  // namespace

void write_vtp_surfaces(const std::filesystem::path& path, const SceneSnapshot& snapshot) {
  check_size(path, snapshot);
  VtpFile file(VtpCells::polygons);
  std::vector<std::uint64_t> serials;
  std::vector<std::uint32_t> faces;
  std::vector<std::uint32_t> vertices;
  for (const SnapshotObject& object : snapshot.objects) {
    const auto first = static_cast<std::int32_t>(vertices.size());
    for (std::uint32_t vertex = 0; vertex < object.mesh->vertex_count(); ++vertex) {
      (void)file.add_point(exported_position(object, vertex));
      vertices.push_back(vertex);
    }
    for (std::uint32_t face = 0; face < object.mesh->face_count(); ++face) {
      for (const std::uint32_t corner : object.mesh->face(face))
        file.add_corner(first + static_cast<std::int32_t>(corner));
      file.end_cell();
      serials.push_back(object.serial);
      faces.push_back(face);
    }
  }
  file.set_point_data("vertex", vertices);
  file.set_cell_data("object", serials);
  file.set_cell_data("face", faces);
  file.write(path);
}

void write_vtp_contacts(const std::filesystem::path& path, const SceneSnapshot& snapshot) {
  ContactPoints points(snapshot);
  for (const PairReport& pair : snapshot.report->pairs())
    for (const Contact& contact : snapshot.report->contacts(pair)) points.add(pair, contact);
  points.write(path);
}

void write_vtp_lines(const std::filesystem::path& path, const SceneSnapshot& snapshot) {
  DistanceLines lines(snapshot);
  for (const PairReport& pair : snapshot.report->pairs()) {
    lines.add(pair, pair.witness);
    for (const RegionDistance& region : snapshot.report->region_distances(pair)) lines.add(pair, region);
    if (!pair.way_out.direction.isZero(0)) lines.add(pair, pair.way_out);
  }
  lines.write(path);
}

}  // namespace graze::io
