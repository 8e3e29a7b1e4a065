// The compiled part of the Python module: carom::Simulation, carom::run and readers of trajectories, with columns as
// numpy arrays. The interface for users is in carom/__init__.py.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/base/build_version.hpp"
#include "core/base/check.hpp"
#include "core/base/wall_clock.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_warnings.hpp"
#include "core/scene/disk_group.hpp"
#include "core/scene/scene_text.hpp"
#include "io/files/output_folder.hpp"
#include "io/movie/frame.hpp"
#include "io/trajectory/scene_frame_reader.hpp"
#include "io/trajectory/trajectory_reader.hpp"
#include "python/interpreter_lock.hpp"
#include "run/recordings/run_view.hpp"
#include "run/scene/run_scene.hpp"
#include "run/simulation/simulation.hpp"

namespace py = pybind11;

namespace carom {

namespace {

using Changes = std::vector<std::pair<std::string, std::string>>;

// A column, copied.
template <class T>
py::array_t<T> copied(const std::vector<T>& column) {
  return py::array_t<T>(static_cast<py::ssize_t>(column.size()), column.data());
}

// A column with one number for all disks.
py::array_t<double> repeated(std::size_t n, double value) {
  py::array_t<double> column(static_cast<py::ssize_t>(n));
  std::fill_n(column.mutable_data(), n, value);
  return column;
}

py::array_t<double> size_column(const std::vector<double>& column, std::size_t n, double common) {
  return column.empty() ? repeated(n, common) : copied(column);
}

// spins: include the column of spins; the disks are rough, but there may be none of them.
py::dict columns_of(const Disks& d, bool spins) {
  py::dict columns;
  columns["x"] = copied(d.x);
  columns["y"] = copied(d.y);
  columns["vx"] = copied(d.vx);
  columns["vy"] = copied(d.vy);
  columns["radius"] = size_column(d.radius, d.size(), d.common_radius);
  columns["mass"] = size_column(d.mass, d.size(), d.common_mass);
  columns["id"] = copied(d.id);
  if (spins) columns["spin"] = copied(d.spin);
  return columns;
}

// For disks of a simulation: the columns of its trajectory, without rounds.
py::dict columns_of(const Disks& d, const Scene& scene) {
  py::dict columns = columns_of(d, d.spins());
  if (!has_several_groups(scene)) return columns;
  const std::vector<DiskId> ends = ends_of_groups(scene);
  std::vector<DiskId> group(d.size());
  std::transform(d.id.begin(), d.id.end(), group.begin(), [&](DiskId id) { return group_of(ends, id); });
  columns["group"] = copied(group);
  return columns;
}

EngineChoice engine_of(const std::string& engine, std::optional<int> threads) {
  if (threads && *threads < 1) throw InputError("threads: expected 1 or more");
  return choose_engine(engine, threads);
}

std::vector<Override> overrides_of(const Changes& changes) {
  std::vector<Override> overrides;
  for (const auto& [key, value] : changes) overrides.push_back({key, value});
  return overrides;
}

// Has the user pressed Ctrl-C? To be called by the thread that holds the interpreter's lock.
bool interrupted() {
  return PyErr_CheckSignals() != 0;
}

// Ctrl-C ends the placing or growth of disks by the exception thrown here. The interpreter's lock, which another thread
// may hold for a while, is taken a few times a second.
auto growth_watch() {
  return [last = WallClock::now()](const GrowthProgress&) mutable {
    constexpr double between_looks = 0.05;
    if (seconds_since(last) < between_looks) return;
    last = WallClock::now();
    const LockTaken lock;
    if (interrupted()) throw py::error_already_set();
  };
}

// A simulation, and the number of arrays that show its columns in place: while there is one, nothing may change. While
// the simulation steps, without the interpreter's lock, its disks move, so other threads must not even look at it.
class PySimulation {
 public:
  explicit PySimulation(Simulation simulation) : simulation_(std::move(simulation)) {}

  const Simulation& look() const {
    check_at_rest();
    simulation_.check_not_lost();
    return simulation_;
  }

  std::vector<std::string> take_warnings() {  // does not change disks
    check_at_rest();
    return simulation_.take_warnings();
  }

  Simulation& change() {
    check_at_rest();
    if (views_ > 0) {
      throw std::runtime_error("a view of the disks is open, or an array of it still in use; close it before changes");
    }
    return simulation_;
  }

  // Makes steps for some time, or this number of steps, or until t; returns the number of steps made. Python handles
  // signals in between.
  Count step_for(Count n, double t, double seconds) {
    Simulation& s = change();
    const Stepping now(*this);  // ends when this thread has the lock again
    const LockGivenUp free;
    const WallClock::time_point start = WallClock::now();
    Count made = 0;
    while (made < n && s.time() < t && !s.done()) {
      s.step();
      ++made;
      if (seconds_since(start) > seconds) break;
    }
    return made;
  }

  // self: the Python object of a PySimulation.
  static py::dict view(const py::object& self) {
    const Disks& d = self.cast<PySimulation&>().look().state().disks;
    const auto shown = [&](const auto& column) {
      using T = typename std::decay_t<decltype(column)>::value_type;
      py::array_t<T> array(static_cast<py::ssize_t>(column.size()), column.data(), guard(self));
      array.attr("flags").attr("writeable") = false;
      return array;
    };
    py::dict columns;
    columns["x"] = shown(d.x);
    columns["y"] = shown(d.y);
    columns["vx"] = shown(d.vx);
    columns["vy"] = shown(d.vy);
    columns["id"] = shown(d.id);
    if (!d.radius.empty()) columns["radius"] = shown(d.radius);
    if (!d.mass.empty()) columns["mass"] = shown(d.mass);
    if (d.spins()) columns["spin"] = shown(d.spin);
    return columns;
  }

 private:
  // Begins and ends with the interpreter's lock held, so that threads agree on it.
  struct Stepping {
    explicit Stepping(PySimulation& s) : of(s) { of.stepping_ = true; }
    ~Stepping() { of.stepping_ = false; }
    Stepping(const Stepping&) = delete;
    Stepping& operator=(const Stepping&) = delete;
    PySimulation& of;
  };

  void check_at_rest() const {
    if (!stepping_) return;
    throw std::runtime_error("the simulation is in a step of another thread; one thread at a time can use it");
  }

  // Every array holds a guard, which counts the array and keeps the simulation, whose memory the array shows, alive:
  // the program's names for the simulation may be gone earlier.
  static py::capsule guard(const py::object& self) {
    auto owner = std::make_unique<py::object>(self);
    py::capsule capsule(owner.get(), [](void* held) {
      const std::unique_ptr<py::object> shown(static_cast<py::object*>(held));
      --shown->cast<PySimulation&>().views_;
    });
    static_cast<void>(owner.release());  // the capsule owns it now
    ++self.cast<PySimulation&>().views_;
    return capsule;
  }

  Simulation simulation_;
  int views_ = 0;          // number of arrays that show columns
  bool stepping_ = false;  // in step_for now
};

// Draws a picture like `carom render`, into a PNG file.
void paint(const PySimulation& s, const std::string& file) {
  const Simulation& look = s.look();
  const PictureLook usual;
  FramePainter painter(frame_style(look.scene(), usual, foreseen_values(look.scene(), look.state().disks)));
  painter.paint(look.state().disks, look.time());
  painter.write_png(file);
}

// Does what `carom run` does, with messages handed to Python. Returns the summary as JSON, the folder, and the names of
// pictures that were lost. An exception raised by a signal ends the run like Ctrl-C, with a checkpoint, and is then
// thrown.
py::tuple run_scene(const Scene& scene, const std::optional<std::string>& folder, const std::string& engine,
                    std::optional<int> threads, bool force, bool strict, const py::function& say) {
  RunSettings settings;
  settings.engine = engine_of(engine, threads);
  settings.force = force;
  settings.strict = strict;
  if (folder) {
    check_output_folder(*folder, scene.file, force);
    settings.folder = *folder;
  }
  std::optional<py::error_already_set> raised;  // KeyboardInterrupt, or the exception of a handler of the program
  settings.listener.growth = growth_watch();
  settings.listener.warning = [&](std::string_view text) {
    const LockTaken lock;
    say(std::string(text));
  };
  settings.listener.stop = [&]() -> std::string {
    const LockTaken lock;
    if (!raised && interrupted()) raised.emplace();
    return raised ? "Ctrl-C" : "";
  };
  RunOutcome outcome;
  {
    const LockGivenUp free;
    outcome = run(scene, std::move(settings));
  }
  if (raised) throw py::error_already_set(*raised);
  return py::make_tuple(json_text(outcome.summary), outcome.folder, outcome.lost_pictures);
}

// Does what `carom view` does. Returns sentences about what the page leaves out.
std::vector<std::string> write_page(const std::string& source, const std::string& file,
                                    std::optional<std::size_t> most_bytes, bool force) {
  const LockGivenUp free;
  const Recording recording = open_recording(source);
  check_page_file(file, force);
  ViewSettings settings;
  if (most_bytes) settings.most_bytes = *most_bytes;
  settings.engine = engine_of("", 1);
  return write_view(file, recording, settings).left_out;
}

// The next frame of a reader, or None.
py::object next_frame(TrajectoryReader& reader) {
  TrajectoryFrame frame;
  bool there = false;
  {
    const LockGivenUp free;
    there = reader.read(frame);
  }
  if (!there) return py::none();
  py::dict columns = columns_of(frame.disks, frame.has_spins);
  if (frame.has_groups) columns["group"] = copied(frame.group);
  if (frame.has_images) {
    columns["image_x"] = copied(frame.image_x);
    columns["image_y"] = copied(frame.image_y);
  }
  return py::make_tuple(frame.time, frame.box.width, frame.box.height, frame.box.periodic_x(), frame.box.periodic_y(),
                        columns);
}

void bind_scene(py::module_& m) {
  py::class_<Scene>(m, "Scene")
      .def_property_readonly("title", [](const Scene& s) { return s.title; })
      .def_property_readonly("file", [](const Scene& s) { return s.file; })
      .def_property_readonly("width", [](const Scene& s) { return s.box.width; })
      .def_property_readonly("height", [](const Scene& s) { return s.box.height; })
      .def_property_readonly("periodic",
                             [](const Scene& s) { return py::make_tuple(s.box.periodic_x(), s.box.periodic_y()); })
      .def_property_readonly("t_end", [](const Scene& s) { return s.run.t_end; })
      .def_property_readonly("seed", [](const Scene& s) { return s.seed; })
      .def("toml", [](const Scene& s) { return resolved_toml(s); })
      .def("warnings", [](const Scene& s) { return scene_warnings(s); });
  m.def("load_scene", [](const std::string& path, const Changes& changes) {
    return load_scene(path, overrides_of(changes), read_scene_frame);
  });
  m.def("parse_scene",
        [](const std::string& text, const std::string& name, const std::string& folder, const Changes& changes) {
          return parse_scene(text, name, folder, overrides_of(changes), read_scene_frame);
        });
}

// Queries of the present state: disks in a rectangle, the nearest disk, the first object that a ray meets.
void bind_queries(py::class_<PySimulation>& simulation) {
  simulation
      .def("disks_in",
           [](const PySimulation& s, double x0, double y0, double x1, double y1) {
             return copied(s.look().disks_in({x0, y0}, {x1, y1}));
           })
      .def("nearest",
           [](const PySimulation& s, double x, double y) -> py::object {
             const auto found = s.look().nearest({x, y});
             return found ? py::object(py::make_tuple(found->id, found->distance)) : py::none();
           })
      .def("cast_ray",
           [](const PySimulation& s, double x, double y, double dx, double dy, double length) -> py::object {
             const auto hit = s.look().cast_ray({x, y}, {dx, dy}, length);
             if (!hit) return py::none();
             constexpr std::array what{"disk", "wall", "sink"};
             return py::make_tuple(hit->id, hit->distance, hit->place.x, hit->place.y,
                                   what[static_cast<std::size_t>(hit->what)]);
           });
}

void bind_simulation(py::module_& m) {
  py::class_<PySimulation> simulation(m, "Simulation");
  simulation
      .def(py::init([](const Scene& scene, const std::string& engine, std::optional<int> threads) {
        const LockGivenUp free;
        return std::make_unique<PySimulation>(Simulation(scene, engine_of(engine, threads), growth_watch()));
      }))
      .def_static("resume",
                  [](const std::string& name, const std::string& engine, std::optional<int> threads) {
                    return std::make_unique<PySimulation>(Simulation::resume(name, engine_of(engine, threads)));
                  })
      .def_static("of_bytes",
                  [](const py::bytes& saved, const std::string& engine, std::optional<int> threads) {
                    return std::make_unique<PySimulation>(
                        Simulation::from_bytes(std::string_view(saved), engine_of(engine, threads)));
                  })
      .def("step_for", &PySimulation::step_for)
      .def("view", &PySimulation::view)
      .def_property_readonly("time", [](const PySimulation& s) { return s.look().time(); })
      .def_property_readonly("exact",
                             [](const PySimulation& s) { return s.look().scene().run.method == Method::exact; })
      .def_property_readonly("done", [](const PySimulation& s) { return s.look().done(); })
      .def_property_readonly("scene", [](const PySimulation& s) { return s.look().scene(); })
      .def_property_readonly("engine", [](const PySimulation& s) { return s.look().engine_choice().name; })
      .def_property_readonly("threads", [](const PySimulation& s) { return s.look().engine_choice().threads; })
      .def_property_readonly("count", [](const PySimulation& s) { return s.look().state().disks.size(); })
      .def_property_readonly("steps", [](const PySimulation& s) { return s.look().state().counters.steps; })
      .def_property_readonly("collisions", [](const PySimulation& s) { return s.look().state().counters.collisions; })
      .def_property_readonly("wall_collisions",
                             [](const PySimulation& s) { return s.look().state().counters.wall_collisions; })
      .def("hash", [](const PySimulation& s) { return hash_text(s.look().hash()); })
      .def("summary", [](const PySimulation& s) { return json_text(s.look().summary()); })
      .def("warnings", &PySimulation::take_warnings)
      .def("contacts", [](const PySimulation& s) { return copied(s.look().contacts()); })
      .def("paint", &paint)
      .def("disks", [](const PySimulation& s) { return columns_of(s.look().disks(), s.look().scene()); })
      .def("disks_at",
           [](const PySimulation& s, double t) {
             Disks disks;
             const double at = s.look().disks_at(t, disks);
             return py::make_tuple(at, columns_of(disks, s.look().scene()));
           })
      .def("save", [](const PySimulation& s, const std::string& file) { s.look().save(file); })
      .def("save_bytes", [](const PySimulation& s) { return py::bytes(s.look().save()); })
      .def("load_bytes", [](PySimulation& s, const py::bytes& bytes) { s.change().load(std::string_view(bytes)); })
      .def("add",
           [](PySimulation& s, double x, double y, double vx, double vy, double radius, double mass, double spin) {
             return s.change().add({x, y, vx, vy, radius, mass, 0, spin});
           })
      .def("remove", [](PySimulation& s, DiskId id) { return s.change().remove(id); })
      .def("set_velocity", [](PySimulation& s, DiskId id, double vx, double vy) {
        return s.change().set_velocity(id, {vx, vy});
      });
  bind_queries(simulation);
}

}  // namespace

}  // namespace carom

PYBIND11_MODULE(_carom, m) {
  using namespace carom;
  PYBIND11_NUMPY_DTYPE(DiskContact, id1, id2, time);
  m.doc() = "The compiled part of carom.";
  // Translators registered later are tried first.
  py::register_exception<RunError>(m, "RunError", PyExc_OSError);
  py::register_exception<PhysicsError>(m, "PhysicsError", PyExc_RuntimeError);
  py::register_exception<InputError>(m, "SceneError", PyExc_ValueError);
  m.attr("version") = build_version();
  bind_scene(m);
  bind_simulation(m);
  m.def("run", &run_scene);
  py::class_<TrajectoryReader>(m, "TrajectoryReader")
      .def("next", &next_frame)
      .def("skip", [](TrajectoryReader& reader) {
        const LockGivenUp free;
        return reader.skip();
      });
  m.def("write_view", &write_page);
  m.def("open_trajectory", [](const std::string& path) { return open_trajectory(path, true); });
  m.def("trajectory_in", [](const std::string& folder) { return trajectory_in(folder).string(); });
}
