#pragma once

/// How Bullet gets at a pair's coefficients: through four global callbacks that are asked about two
/// bodies each time a contact point is made or renewed.
namespace slipcheck::bullet {

/// From now on the callbacks look the pair up: a body's user index is its index in the scene
/// (kFloor, kWall, kLid of coefficients.h for what is no ball) and its user pointer the
/// PairCoefficients. Laws over the speed are taken at the bodies' present velocities, which are
/// those before the step.
void combine_by_pair();

/// Back to Bullet's own rules: products for friction and restitution, r0 f1 + r1 f0 for rolling and
/// spinning friction.
void combine_as_shipped();

}  // namespace slipcheck::bullet
