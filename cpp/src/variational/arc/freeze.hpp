// Where rows of an arc are held: at corners, ends and rims, in the planes of faces (rows.hpp).
#pragma once

#include "variational/arc/rows.hpp"

namespace saltus {

/// A sharp corner on a face; the end of a rod of which an edge rests already.
bool is_held_in_plane(const ModelData& model, const Row& row, const Node& node);

/// Holds the row in the plane of b that touches at the node.
void freeze(const ModelData& model, const Node& node, Row& row);

/// Holds two edges that lie along each other, nearly, at the point where they touch at the node.
void hold_edges(const ModelData& model, const Node& node, Row& row);

/// Two edges that cross, and are held at the point where they do so at the arc's start. They slide
/// along each other and turn: their own gap is no plane's. Where both of their points stay together
/// it is closed all the same, so that the rates of many such rows do not contradict each other.
bool is_held_crossing(const ModelData& model, const Row& row, const Node& node);

/// The round end of a rod goes round the border of a face, if the rod lies along the border. One
/// that lies across it is borne by the border behind its end, which stays level: where the rod as a
/// whole sinks, though its ends do not, they are held in the plane of the face from now on.
/// @return true where one is that was not
bool level_rods(const Scene& scene, const VecX& q_end, const Node& node, Rows& rows, ArcScratch& s);

}  // namespace saltus
