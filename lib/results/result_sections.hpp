#pragma once

#include "results/netcdf_writer.hpp"
#include "results/result_content.hpp"

// The parts of a results file, contract section 4, in the order in which they are written.
namespace coordreq {

/// Attributes of the file, and `/spec`.
void write_header(NetcdfWriter& file, const ResultContent& content);

/// The dimensions that the datasets below share: states and inputs with their grid points, `/partition`,
/// `/layer`.
void write_axes(NetcdfWriter& file, const ResultContent& content);

/// `/safe`, `/invariant`, with their sizes as attribute `cells`, and `/collision_time`.
void write_sets(NetcdfWriter& file, const ResultContent& content);

/// `/delay` and `/trigger`.
void write_delays(NetcdfWriter& file, const ResultContent& content);

/// `/layer_size`, `/fixed_point_index`, and on request `/layers`.
void write_layers(NetcdfWriter& file, const ResultContent& content);

/// On request `/actions` and `/controller`. The dimension of the bytes of a set of actions stands beside it,
/// under its name and ":byte", which no agent and no state can have.
void write_actions(NetcdfWriter& file, const ResultContent& content);

/// On request `/abstraction`.
void write_abstraction(NetcdfWriter& file, const ResultContent& content);

/// What else is known of each cell, after the axes that only these maps have.
void write_maps(NetcdfWriter& file, const ResultContent& content);

}  // namespace coordreq
