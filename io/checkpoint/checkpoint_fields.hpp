// The content of a checkpoint, struct by struct. Each is taken apart by a structured binding, which fails to compile if
// a member is added: then add it here, too, and increase the format's number (checkpoint.cpp).
#pragma once

#include "io/checkpoint/checkpoint.hpp"
#include "io/files/byte_stream.hpp"

namespace carom {

template <class Stream, Is<Disks> T>
void fields(Stream& stream, T& value) {
  auto& [x, y, vx, vy, id, radius, mass, common_radius, common_mass, spin, inertia] = value;
  stream(x, y, vx, vy, id, radius, mass, common_radius, common_mass, spin, inertia);
}

template <class Stream, Is<Counters> T>
void fields(Stream& stream, T& value) {
  auto& [steps, collisions, wall_collisions, removed, emitted, waiting, disk_time, disk_time_excess, virial,
         emitted_energy, wall_impulse, side_energy, thermostat_heat, shear_virial, shear_work, wall_work, wall_push] =
      value;
  stream(steps, collisions, wall_collisions, removed, emitted, waiting, disk_time, disk_time_excess, virial,
         emitted_energy, wall_impulse, side_energy, thermostat_heat, shear_virial, shear_work, wall_work, wall_push);
}

template <class Stream, Is<SourceState> T>
void fields(Stream& stream, T& value) {
  auto& [emitted] = value;
  stream(emitted);
}

template <class Stream, Is<ContactLoad> T>
void fields(Stream& stream, T& value) {
  auto& [id1, id2, force] = value;
  stream(id1, id2, force);
}

template <class Stream, Is<Obstacle> T>
void fields(Stream& stream, T& value) {
  auto& [x, y, dx, dy, radius, restitution, id, kind, moves] = value;
  stream(x, y, dx, dy, radius, restitution, id, kind, moves);
}

template <class Stream, Is<StallWatch> T>
void fields(Stream& stream, T& value) {
  auto& [frames, since] = value;
  stream(frames, since);
}

template <class Stream, Is<Overlap> T>
void fields(Stream& stream, T& value) {
  auto& [size, id1, id2] = value;
  stream(size, id1, id2);
}

template <class Stream, Is<WorstOverlap> T>
void fields(Stream& stream, T& value) {
  auto& [overlap, time] = value;
  stream(overlap, time);
}

template <class Stream, Is<WorstFigure> T>
void fields(Stream& stream, T& value) {
  auto& [figure, time] = value;
  stream(figure, time);
}

template <class Stream, Is<ValidityCounts> T>
void fields(Stream& stream, T& value) {
  auto& [inaccurate, inaccurate_at_walls, frames, since, split_told, overlap_told, inaccurate_told, slow_told,
         late_at_walls_told, disks, wall, parts, advance, crushed] = value;
  stream(inaccurate, inaccurate_at_walls, frames, since, split_told, overlap_told, inaccurate_told, slow_told,
         late_at_walls_told, disks, wall, parts, advance, crushed);
}

template <class Stream, Is<State> T>
void fields(Stream& stream, T& value) {
  auto& [disks, time, counters, next_id, intervals, step_begun, sources, taken, loads, stall, validity, window,
         obstacles, last_contact, thermal_hits] = value;
  stream(disks, time, counters, next_id, intervals, step_begun, sources, taken, loads, stall, validity, window,
         obstacles, last_contact, thermal_hits);
}

template <class Stream, Is<FileMark> T>
void fields(Stream& stream, T& value) {
  auto& [name, frames, bytes] = value;
  stream(name, frames, bytes);
}

template <class Stream, Is<IntervalMeans> T>
void fields(Stream& stream, T& value) {
  auto& [pressure, collision_rate, force, shear_stress] = value;
  stream(pressure, collision_rate, force, shear_stress);
}

template <class Stream, Is<MeterMark> T>
void fields(Stream& stream, T& value) {
  auto& [counted_until, before, means] = value;
  stream(counted_until, before, means);
}

template <class Stream, Is<SeriesMark> T>
void fields(Stream& stream, T& value) {
  auto& [file, meter] = value;
  stream(file, meter);
}

template <class Stream, Is<MovieMark> T>
void fields(Stream& stream, T& value) {
  auto& [frames, single_frames, parts, low, high, time_decimals] = value;
  stream(frames, single_frames, parts, low, high, time_decimals);
}

template <class Stream, Is<VelocityRecord::Curve> T>
void fields(Stream& stream, T& value) {
  auto& [id, t, vx, vy] = value;
  stream(id, t, vx, vy);
}

template <class Stream, Is<VelocityBand> T>
void fields(Stream& stream, T& value) {
  auto& [t, vx, vy] = value;
  stream(t, vx, vy);
}

template <class Stream, Is<VelocityRecord> T>
void fields(Stream& stream, T& value) {
  auto& [curves, end, bands, most] = value;
  stream(curves, end, bands, most);
}

template <class Stream, Is<EnergyRecord> T>
void fields(Stream& stream, T& value) {
  auto& [t, kinetic, potential, total] = value;
  stream(t, kinetic, potential, total);
}

template <class Stream, Is<PairRecord> T>
void fields(Stream& stream, T& value) {
  auto& [counts, centres, expected] = value;
  stream(counts, centres, expected);
}

template <class Stream, Is<SampleSeries> T>
void fields(Stream& stream, T& value) {
  auto& [time, disks, displacement, followed, temperature, interval, pressure, collision_rate, autocorrelation,
         local_order, global_order, bond_autocorrelation] = value;
  stream(time, disks, displacement, followed, temperature, interval, pressure, collision_rate, autocorrelation,
         local_order, global_order, bond_autocorrelation);
}

template <class Stream, Is<SpeedHistogram> T>
void fields(Stream& stream, T& value) {
  auto& [counts, beyond, samples, temperature_sum, largest_seen] = value;
  stream(counts, beyond, samples, temperature_sum, largest_seen);
}

template <class Stream, Is<DensityProfile> T>
void fields(Stream& stream, T& value) {
  auto& [centres, covered, samples] = value;
  stream(centres, covered, samples);
}

template <class Stream, Is<AxisTally> T>
void fields(Stream& stream, T& value) {
  auto& [from, sixteenth] = value;
  stream(from, sixteenth);
}

template <class Stream, Is<DisplacementTally> T>
void fields(Stream& stream, T& value) {
  auto& [begun, x, y, looked_at, fastest, checked_at, doubtful] = value;
  stream(begun, x, y, looked_at, fastest, checked_at, doubtful);
}

template <class Stream, Is<MotionProfile> T>
void fields(Stream& stream, T& value) {
  auto& [disks, mass, px, py, twice_thermal, samples] = value;
  stream(disks, mass, px, py, twice_thermal, samples);
}

template <class Stream, Is<StructureFactor> T>
void fields(Stream& stream, T& value) {
  auto& [along_x, along_y, samples] = value;
  stream(along_x, along_y, samples);
}

template <class Stream, Is<VelocityMemory> T>
void fields(Stream& stream, T& value) {
  auto& [begun, vx, vy] = value;
  stream(begun, vx, vy);
}

template <class Stream, Is<BondCorrelation> T>
void fields(Stream& stream, T& value) {
  auto& [product, pairs, samples] = value;
  stream(product, pairs, samples);
}

template <class Stream, Is<BondMemory> T>
void fields(Stream& stream, T& value) {
  auto& [begun, real, imaginary] = value;
  stream(begun, real, imaginary);
}

template <class Stream, Is<AnalysisRecord> T>
void fields(Stream& stream, T& value) {
  auto& [counted_until, before, series, pairs, partial, speeds, density, density_rows, displacement, motion,
         motion_rows, structure, velocities, bonds, orders] = value;
  stream(counted_until, before, series, pairs, partial, speeds, density, density_rows, displacement, motion,
         motion_rows, structure, velocities, bonds, orders);
}

template <class Stream, Is<OutputMark> T>
void fields(Stream& stream, T& value) {
  auto& [frames, last_time, trajectory, series, meter, movie, velocities, energies, analysis, rounds] = value;
  stream(frames, last_time, trajectory, series, meter, movie, velocities, energies, analysis, rounds);
}

template <class Stream, Is<Energy> T>
void fields(Stream& stream, T& value) {
  auto& [kinetic, potential, rotational] = value;
  stream(kinetic, potential, rotational);
}

template <class Stream, Is<Momentum> T>
void fields(Stream& stream, T& value) {
  auto& [x, y, magnitude] = value;
  stream(x, y, magnitude);
}

template <class Stream, Is<RunStart> T>
void fields(Stream& stream, T& value) {
  auto& [particles, time, energy, momentum, relative] = value;
  stream(particles, time, energy, momentum, relative);
}

template <class Stream, Is<RunRecord> T>
void fields(Stream& stream, T& value) {
  auto& [version, scene_file, scene_text, engine, start, outputs, wall_s, cpu_s, step_s, resumed, warnings] = value;
  stream(version, scene_file, scene_text, engine, start, outputs, wall_s, cpu_s, step_s, resumed, warnings);
}

}  // namespace carom
