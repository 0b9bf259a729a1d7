// SPDX-License-Identifier: Apache-2.0
// Files of triangles, read again by readers that know the formats only from their descriptions.
#include <gtest/gtest.h>

#include <array>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "../common/angles.h"
#include "../common/mesh_checks.h"
#include "../common/mesh_shapes.h"
#include "obvid/exchange/internal/mesh/files.h"

namespace obvid {
namespace {

struct Drawn {
  SurfaceModel model;
  std::vector<Mesh> meshes;
};

Drawn drawn(SurfaceModel model, double tolerance) {
  auto meshes = tessellate(model, {tolerance, 10.0});
  EXPECT_TRUE(meshes) << (meshes ? "" : meshes.error().what);
  return {std::move(model), meshes ? *meshes : std::vector<Mesh>{}};
}

Drawn ball(double tolerance, double radius = 1.0, Vec3 at = {}) {
  SurfaceModel model;
  auto [west, east] = split_v(shapes::moved(shapes::sphere(radius), 1.0, at), 0.5);
  model.name = "ball";
  model.patches = {{"south", west}, {"north", east}};
  return drawn(std::move(model), tolerance);
}

template <class T>
T number_at(const std::string& bytes, std::size_t offset) {
  T value{};
  EXPECT_LE(offset + sizeof(T), bytes.size());
  if (offset + sizeof(T) <= bytes.size()) std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

Vec3 vector_at(const std::string& bytes, std::size_t offset) {
  return {number_at<float>(bytes, offset), number_at<float>(bytes, offset + 4),
          number_at<float>(bytes, offset + 8)};
}

/// Triangles of a binary STL file as a mesh, each with its own vertices.
Mesh read_stl(const std::string& bytes) {
  Mesh mesh;
  const auto count = number_at<std::uint32_t>(bytes, 80);
  EXPECT_EQ(bytes.size(), 84u + 50u * count);
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::size_t at = 84 + 50 * std::size_t{k};
    for (std::size_t i = 0; i < 3; ++i) {
      mesh.vertices.push_back({vector_at(bytes, at + 12 + 12 * i), vector_at(bytes, at), 0.0, 0.0});
    }
    mesh.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    EXPECT_EQ(number_at<std::uint16_t>(bytes, at + 48), 0);
  }
  return mesh;
}

TEST(MeshFiles, StlOfABallIsClosedAndConvergesInVolumeAndArea) {
  double before = 40.0;
  for (const double tolerance : {0.1, 0.01, 0.001}) {
    const Drawn d = ball(tolerance);
    const auto text = stl_text(d.model, d.meshes);
    ASSERT_TRUE(text) << text.error().what;
    const Mesh mesh = read_stl(*text);
    for (const auto& [edge, count] : checks::directed_edges({mesh})) ASSERT_EQ(count, 1);
    EXPECT_TRUE(checks::open_edges({mesh}).empty());
    EXPECT_EQ(checks::turned_over(mesh), 0u);  // normals of the file against the order of corners
    for (const MeshVertex& v : mesh.vertices) {
      ASSERT_NEAR(norm(v.normal), 1.0, 1e-6);
      ASSERT_GT(dot(v.normal, v.point), 0.0);  // outwards
    }
    const double off = 4.0 / 3.0 * kPi - checks::volume({mesh});
    EXPECT_GT(off, 0.0);
    EXPECT_LT(off, 4.0 * kPi * tolerance);  // a shell as thick as the tolerance
    EXPECT_LT(off, before / 5.0);
    EXPECT_NEAR(checks::area(mesh), 4.0 * kPi, 8.0 * kPi * tolerance);
    before = off;
  }
}

TEST(MeshFiles, StlNamesItsUnitAndIsNotTakenForText) {
  Drawn d = ball(0.1);
  d.model.name =
      "solid\nof m\xC3\xBCller and a name that goes on and on for more than the header holds";
  d.model.units = "in";
  const auto text = stl_text(d.model, d.meshes);
  ASSERT_TRUE(text);
  const std::string head = text->substr(0, 80);
  EXPECT_NE(head.substr(0, 5), "solid");
  EXPECT_NE(head.find("unit in"), std::string::npos);
  for (const char c : head) EXPECT_TRUE(c >= ' ' && c <= '~');
}

TEST(MeshFiles, StlFarFromTheOriginStaysClosedAndItsLossIsTold) {
  const Drawn d = ball(0.01, 1.0, {1e6, 0.0, 0.0});
  const auto text = stl_text(d.model, d.meshes);
  ASSERT_TRUE(text);
  EXPECT_TRUE(checks::open_edges({read_stl(*text)}).empty());
  // single precision has steps of 1/16 between 2^19 and 2^20
  EXPECT_LE(single_precision_loss(d.meshes), 0.5 / 16.0 + 1e-7);
  EXPECT_GT(single_precision_loss(d.meshes), 0.4 / 16.0);
  EXPECT_LT(single_precision_loss(ball(0.01).meshes), 1e-7);
}

struct Obj {
  std::vector<Vec3> points, normals;
  std::vector<std::array<double, 2>> textures;
  std::map<std::string, std::vector<std::array<std::array<std::size_t, 3>, 3>>> objects;
};

Obj read_obj(const std::string& text) {
  Obj obj;
  std::istringstream lines(text);
  lines.imbue(std::locale::classic());
  std::string line, object;
  while (std::getline(lines, line)) {
    std::istringstream in(line);
    in.imbue(std::locale::classic());
    std::string what;
    in >> what;
    if (what == "o") in >> object;
    Vec3 p;
    if (what == "v" && in >> p.x >> p.y >> p.z) obj.points.push_back(p);
    if (what == "vn" && in >> p.x >> p.y >> p.z) obj.normals.push_back(p);
    if (what == "vt" && in >> p.x >> p.y) obj.textures.push_back({p.x, p.y});
    if (what != "f") continue;
    std::array<std::array<std::size_t, 3>, 3> face{};
    for (auto& corner : face) {
      char slash = 0;
      EXPECT_TRUE(in >> corner[0] >> slash >> corner[1] >> slash >> corner[2]) << line;
    }
    obj.objects[object].push_back(face);
  }
  return obj;
}

TEST(MeshFiles, ObjHasAllDigitsSharedPointsAndAnObjectForEachPatch) {
  Drawn d = ball(0.01, 1.0 / 3.0);
  d.model.patches[1].name = "north\n# pole";
  const auto text = obj_mesh_text(d.model, d.meshes);
  ASSERT_TRUE(text);
  const Obj obj = read_obj(*text);
  ASSERT_EQ(obj.objects.size(), 2u);
  ASSERT_TRUE(obj.objects.count("south"));
  ASSERT_TRUE(obj.objects.count("north_#_pole"));
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  std::size_t faces = 0;
  for (const auto& [name, list] : obj.objects) {
    for (const auto& face : list) {
      ++faces;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& [v, vt, vn] = face[k];
        ASSERT_TRUE(v >= 1 && v <= obj.points.size());
        ASSERT_TRUE(vt >= 1 && vt <= obj.textures.size());
        ASSERT_TRUE(vn >= 1 && vn <= obj.normals.size());
        ASSERT_NEAR(norm(obj.points[v - 1]), 1.0 / 3.0, 1e-15);
        ASSERT_NEAR(dot(obj.normals[vn - 1], obj.points[v - 1]), 1.0 / 3.0, 1e-5);
        ASSERT_TRUE(obj.textures[vt - 1][0] >= 0.0 && obj.textures[vt - 1][0] <= 1.0);
        ++edges[{v, face[(k + 1) % 3][0]}];
      }
    }
  }
  EXPECT_EQ(faces, d.meshes[0].triangles.size() + d.meshes[1].triangles.size());
  for (const auto& [edge, count] : edges) {  // closed by numbers alone
    ASSERT_EQ(count, 1);
    ASSERT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
}

TEST(MeshFiles, NumbersDoNotDependOnTheLocale) {
  const Drawn d = ball(0.1);
  const auto plain = obj_mesh_text(d.model, d.meshes), glb = glb_text(d.model, d.meshes);
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::string old = std::setlocale(LC_ALL, nullptr);
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  static_cast<void>(std::setlocale(LC_ALL, "de_DE.UTF-8"));  // where there is one
  const auto obj = obj_mesh_text(d.model, d.meshes), other = glb_text(d.model, d.meshes);
  std::locale::global(before);
  std::setlocale(LC_ALL, old.c_str());
  EXPECT_EQ(*obj, *plain);
  EXPECT_EQ(*other, *glb);
}

/// A GLB file taken apart, with all that the format demands of what is used here.
struct Glb {
  nlohmann::json document;
  std::string data;

  [[nodiscard]] std::vector<double> numbers(std::size_t accessor) const {
    const auto& a = document.at("accessors").at(accessor);
    const auto& view = document.at("bufferViews").at(a.at("bufferView").get<std::size_t>());
    const std::map<std::string, std::size_t> kWidths = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}};
    const std::size_t width = kWidths.at(a.at("type")), count = a.at("count");
    const std::size_t from = view.at("byteOffset"), length = view.at("byteLength");
    EXPECT_EQ(view.at("buffer"), 0);
    EXPECT_EQ(from % 4, 0u);
    EXPECT_EQ(length, 4 * width * count);
    EXPECT_LE(from + length, data.size());
    EXPECT_GE(count, 1u);
    const bool is_index = width == 1;
    EXPECT_EQ(a.at("componentType"), is_index ? 5125 : 5126);
    EXPECT_EQ(view.at("target"), is_index ? 34963 : 34962);
    std::vector<double> all;
    for (std::size_t k = 0; k < width * count; ++k) {
      all.push_back(is_index ? number_at<std::uint32_t>(data, from + 4 * k)
                             : static_cast<double>(number_at<float>(data, from + 4 * k)));
    }
    return all;
  }
};

Glb read_glb(const std::string& bytes) {
  Glb glb;
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 4), 2u);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 8), bytes.size());
  const auto json_size = number_at<std::uint32_t>(bytes, 12);
  EXPECT_EQ(json_size % 4, 0u);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  glb.document = nlohmann::json::parse(bytes.substr(20, json_size));
  const std::size_t second = 20 + std::size_t{json_size};
  const auto data_size = number_at<std::uint32_t>(bytes, second);
  EXPECT_EQ(bytes.substr(second + 4, 4), std::string("BIN\0", 4));
  EXPECT_EQ(second + 8 + data_size, bytes.size());
  glb.data = bytes.substr(second + 8);
  EXPECT_EQ(glb.document.at("asset").at("version"), "2.0");
  EXPECT_EQ(glb.document.at("buffers").size(), 1u);
  EXPECT_EQ(glb.document.at("buffers").at(0).at("byteLength"), glb.data.size());
  EXPECT_FALSE(glb.document.at("buffers").at(0).contains("uri"));
  return glb;
}

Vec3 vec3(const nlohmann::json& a) { return {a.at(0), a.at(1), a.at(2)}; }

/// A point through the translation, rotation and scale of a node.
Vec3 placed_by(const nlohmann::json& node, Vec3 p) {
  const Vec3 scaled{node.at("scale").at(0).get<double>() * p.x,
                    node.at("scale").at(1).get<double>() * p.y,
                    node.at("scale").at(2).get<double>() * p.z};
  const Vec3 q = vec3(node.at("rotation"));
  const double w = node.at("rotation").at(3);
  return vec3(node.at("translation")) + scaled + 2.0 * w * cross(q, scaled) +
         2.0 * cross(q, cross(q, scaled));
}

/// All triangles in the scene's place, normals as they are.
std::vector<Mesh> scene_of(const Glb& glb) {
  std::vector<Mesh> meshes;
  const auto& root = glb.document.at("nodes").at(
      glb.document.at("scenes").at(0).at("nodes").at(0).get<std::size_t>());
  for (const std::size_t child : root.at("children")) {
    const auto& node = glb.document.at("nodes").at(child);
    const auto& mesh = glb.document.at("meshes").at(node.at("mesh").get<std::size_t>());
    EXPECT_EQ(mesh.at("primitives").size(), 1u);
    const auto& primitive = mesh.at("primitives").at(0);
    EXPECT_EQ(primitive.at("mode"), 4);
    const auto& attributes = primitive.at("attributes");
    const auto points = glb.numbers(attributes.at("POSITION"));
    const auto normals = glb.numbers(attributes.at("NORMAL"));
    const auto textures = glb.numbers(attributes.at("TEXCOORD_0"));
    const auto indices = glb.numbers(primitive.at("indices"));
    EXPECT_EQ(points.size(), normals.size());
    EXPECT_EQ(points.size() / 3, textures.size() / 2);
    const auto& bounds =
        glb.document.at("accessors").at(attributes.at("POSITION").get<std::size_t>());
    std::array<double, 3> low{}, high{};
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    Mesh out;
    for (std::size_t k = 0; k < points.size(); k += 3) {
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], points[k + i]);
        high[i] = std::max(high[i], points[k + i]);
      }
      const Vec3 n{normals[k], normals[k + 1], normals[k + 2]};
      EXPECT_NEAR(norm(n), 1.0, 1e-5);
      out.vertices.push_back({placed_by(root, {points[k], points[k + 1], points[k + 2]}), n, 0, 0});
    }
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(bounds.at("min").at(i).get<double>(), low[i]);
      EXPECT_EQ(bounds.at("max").at(i).get<double>(), high[i]);
    }
    for (const double t : textures) EXPECT_TRUE(t >= 0.0 && t <= 1.0);
    EXPECT_EQ(indices.size() % 3, 0u);
    for (std::size_t k = 0; k + 2 < indices.size(); k += 3) {
      std::array<std::uint32_t, 3> t{};
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT(indices[k + i], static_cast<double>(out.vertices.size()));
        t[i] = static_cast<std::uint32_t>(indices[k + i]);
      }
      out.triangles.push_back(t);
    }
    const std::size_t material = primitive.at("material");
    EXPECT_EQ(glb.document.at("materials").at(material).at("doubleSided"), true);
    meshes.push_back(std::move(out));
  }
  return meshes;
}

TEST(MeshFiles, GlbIsInMetresWithYUpAndSoundInStructure) {
  Drawn d = ball(0.01, 25.0, {100.0, 200.0, 300.0});
  const auto text = glb_text(d.model, d.meshes);
  ASSERT_TRUE(text);
  const Glb glb = read_glb(*text);
  EXPECT_EQ(glb.document.at("meshes").size(), 2u);
  EXPECT_EQ(glb.document.at("meshes").at(1).at("name"), "north");
  const std::vector<Mesh> scene = scene_of(glb);
  ASSERT_EQ(scene.size(), 2u);
  // mm to m; x stays, z becomes y, y becomes -z
  const Vec3 centre{0.1, 0.3, -0.2};
  for (const Mesh& mesh : scene) {
    for (const MeshVertex& v : mesh.vertices) ASSERT_NEAR(norm(v.point - centre), 0.025, 1e-8);
  }
  double highest = 0.0;
  for (const MeshVertex& v : scene[1].vertices) highest = std::max(highest, v.point.y);
  EXPECT_NEAR(highest, 0.325, 1e-8);  // the north is above
  EXPECT_TRUE(checks::open_edges(scene).empty());
  EXPECT_NEAR(checks::volume(scene, centre), 4.0 / 3.0 * kPi * std::pow(0.025, 3.0),
              4.0 * kPi * 0.025 * 0.025 * 1e-5);
}

TEST(MeshFiles, GlbKeepsDigitsFarFromTheOrigin) {
  Drawn d = ball(0.01, 1.0, {1e7, -2e7, 3e7});
  d.model.units = "m";
  const auto text = glb_text(d.model, d.meshes);
  ASSERT_TRUE(text);
  for (const Mesh& mesh : scene_of(read_glb(*text))) {
    for (const MeshVertex& v : mesh.vertices) {
      ASSERT_NEAR(norm(v.point - Vec3{1e7, 3e7, 2e7}), 1.0, 5e-8);  // 1e7: steps of 4e-9
    }
  }
}

TEST(MeshFiles, GlbTakesNamesThatAreNotText) {
  Drawn d = ball(0.1);
  d.model.name = "\xFF\xFE\"\\\n";
  d.model.patches[0].name = "";
  const auto text = glb_text(d.model, d.meshes);
  ASSERT_TRUE(text);
  const Glb glb = read_glb(*text);
  EXPECT_EQ(glb.document.at("meshes").at(0).at("name"), "patch 1");
}

TEST(MeshFiles, PlyHoldsWhatItsHeaderSays) {
  const Drawn d = ball(0.01);
  const auto text = ply_text(d.model, d.meshes);
  ASSERT_TRUE(text);
  const std::string end = "end_header\n";
  const std::size_t body = text->find(end) + end.size();
  const std::string head = text->substr(0, body);
  const std::size_t vertices = d.meshes[0].vertices.size() + d.meshes[1].vertices.size();
  const std::size_t triangles = d.meshes[0].triangles.size() + d.meshes[1].triangles.size();
  EXPECT_EQ(head.rfind("ply\nformat binary_little_endian 1.0\n", 0), 0u);
  EXPECT_NE(head.find("element vertex " + std::to_string(vertices) + "\n"), std::string::npos);
  EXPECT_NE(head.find("element face " + std::to_string(triangles) + "\n"), std::string::npos);
  constexpr std::size_t kVertex = 3 * 8 + 5 * 4, kFace = 1 + 3 * 4 + 4;
  ASSERT_EQ(text->size(), body + kVertex * vertices + kFace * triangles);
  Mesh all;
  for (std::size_t k = 0; k < vertices; ++k) {
    const std::size_t at = body + kVertex * k;
    all.vertices.push_back({{number_at<double>(*text, at), number_at<double>(*text, at + 8),
                             number_at<double>(*text, at + 16)},
                            vector_at(*text, at + 24),
                            0.0,
                            0.0});
  }
  for (std::size_t k = 0; k < triangles; ++k) {
    const std::size_t at = body + kVertex * vertices + kFace * k;
    ASSERT_EQ((*text)[at], 3);
    std::array<std::uint32_t, 3> t{};
    for (std::size_t i = 0; i < 3; ++i) {
      t[i] = number_at<std::uint32_t>(*text, at + 1 + 4 * i);
      ASSERT_LT(t[i], vertices);
    }
    EXPECT_EQ(number_at<std::int32_t>(*text, at + 13), k < d.meshes[0].triangles.size() ? 0 : 1);
    all.triangles.push_back(t);
  }
  EXPECT_TRUE(checks::open_edges({all}).empty());
  EXPECT_EQ(checks::turned_over(all), 0u);
}

TEST(MeshFiles, RefusesWhatDoesNotBelongTogether) {
  const Drawn good = ball(0.1);
  const auto code = [](const SurfaceModel& model, const std::vector<Mesh>& meshes) {
    std::vector<ErrorCode> codes;
    for (const auto& text : {stl_text(model, meshes), obj_mesh_text(model, meshes),
                             glb_text(model, meshes), ply_text(model, meshes)}) {
      codes.push_back(text ? ErrorCode::kInternal : text.error().code);
    }
    EXPECT_EQ(std::count(codes.begin(), codes.end(), codes.front()), 4);
    return codes.front();
  };
  EXPECT_EQ(code(good.model, {good.meshes[0]}), ErrorCode::kBadCount);
  EXPECT_EQ(code({}, {}), ErrorCode::kNothingThere);
  EXPECT_EQ(code(good.model, {Mesh{}, Mesh{}}), ErrorCode::kNothingThere);
  auto loose = good.meshes;
  loose[1].triangles.push_back({0, 1, 1000000});
  EXPECT_EQ(code(good.model, loose), ErrorCode::kBadCount);
  auto infinite = good.meshes;
  infinite[0].vertices[3].point.z = std::numeric_limits<double>::infinity();
  EXPECT_EQ(code(good.model, infinite), ErrorCode::kNotFinite);
  auto huge = good.meshes;
  for (MeshVertex& v : huge[0].vertices) v.point = 1e300 * v.point;
  const auto stl = stl_text(good.model, huge), glb = glb_text(good.model, huge);
  ASSERT_FALSE(stl);
  ASSERT_FALSE(glb);
  EXPECT_EQ(stl.error().code, ErrorCode::kSizeOutOfRange);
  EXPECT_EQ(glb.error().code, ErrorCode::kSizeOutOfRange);
}

TEST(MeshFiles, APatchWithoutTrianglesLeavesTheOthersAsTheyAre) {
  Drawn d = ball(0.1);
  d.meshes[0] = {};
  for (const auto& text : {stl_text(d.model, d.meshes), obj_mesh_text(d.model, d.meshes),
                           ply_text(d.model, d.meshes)}) {
    EXPECT_TRUE(text);
  }
  const auto glb = glb_text(d.model, d.meshes);
  ASSERT_TRUE(glb);
  EXPECT_EQ(scene_of(read_glb(*glb)).size(), 1u);
}

}  // namespace
}  // namespace obvid
