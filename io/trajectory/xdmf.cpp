#include "io/trajectory/xdmf.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "io/files/output_file.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

constexpr const char* disks_in_file = "/particles/disks/";

// The row of one frame in a dataset [frame][place] or [frame][place][components].
std::string row_of(const XdmfPlan& plan, const std::string& data, std::size_t frame, int components,
                   const std::string& type) {
  const std::string tail = components > 1 ? fmt::format(" {}", components) : "";
  const std::string zeros = components > 1 ? " 0" : "", ones = components > 1 ? " 1" : "";
  return fmt::format(
      "<DataItem ItemType=\"HyperSlab\" Dimensions=\"{0}{1}\"><DataItem Dimensions=\"3 {2}\" Format=\"XML\">"
      "{3} 0{4} 1 1{5} 1 {0}{1}</DataItem><DataItem {6} Dimensions=\"{7} {0}{1}\" Format=\"HDF\">{8}</DataItem>"
      "</DataItem>",
      plan.places, tail, components > 1 ? 3 : 2, frame, zeros, ones, type, plan.times.size(), data);
}

std::string attribute(const char* name, const char* type, const std::string& item) {
  return fmt::format("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n", name, type, item);
}

std::string grid(const XdmfPlan& plan, const std::string& h5, std::size_t frame) {
  const std::string place_type = fmt::format("NumberType=\"Float\" Precision=\"{}\"", plan.width);
  const std::string size_type = "NumberType=\"Float\" Precision=\"8\"";
  const std::string id_type = "NumberType=\"UInt\" Precision=\"4\"";
  const auto data = [&](const char* name) { return h5 + ":" + disks_in_file + name; };
  const auto size = [&](const char* name) {
    if (plan.sizes_each_frame) return row_of(plan, data(name) + "/value", frame, 1, size_type);
    return fmt::format("<DataItem {} Dimensions=\"{}\" Format=\"HDF\">{}</DataItem>", size_type, plan.places,
                       data(name));
  };
  return fmt::format("<Grid Name=\"disks\">\n<Time Value=\"{}\"/>\n", plan.times[frame]) +
         fmt::format("<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\"/>\n", plan.places) +
         fmt::format("<Geometry GeometryType=\"{}\">{}</Geometry>\n", plan.dimensions == 3 ? "XYZ" : "XY",
                     row_of(plan, data("position/value"), frame, plan.dimensions, place_type)) +
         attribute("velocity", "Vector", row_of(plan, data("velocity/value"), frame, plan.dimensions, place_type)) +
         attribute("id", "Scalar", row_of(plan, data("id/value"), frame, 1, id_type)) +
         attribute("radius", "Scalar", size("radius")) + attribute("mass", "Scalar", size("mass")) + "</Grid>\n";
}

}  // namespace

void write_xdmf(const std::string& h5_path, const XdmfPlan& plan) {
  const std::string h5 = fs::path(h5_path).filename().string();
  OutputFile file(fs::path(h5_path).replace_extension(".xdmf").string());
  file.write(
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
      "<Grid Name=\"trajectory\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
  for (std::size_t frame = 0; frame < plan.times.size(); ++frame) file.write(grid(plan, h5, frame));
  file.write("</Grid>\n</Domain>\n</Xdmf>\n");
  file.close();
}

}  // namespace carom
