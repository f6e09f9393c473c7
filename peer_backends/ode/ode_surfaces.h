#pragma once

#include <ode/ode.h>

#include "physics/surface.h"

namespace slipcheck::ode {

/// A surface as a geom without a body: a plane, a box of as good as no thickness, a cylinder, a
/// sphere. ODE's functions for these and a sphere take the nearest point of the shape, so that a
/// plate is met where it is, on either face and round its edges.
dGeomID make_geom(dSpaceID space, const SurfaceShape& shape);

/// Puts it where its surface is at a time [s].
void lay(dGeomID geom, const Surface& surface, double time);

}  // namespace slipcheck::ode
