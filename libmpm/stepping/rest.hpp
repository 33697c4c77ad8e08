#pragma once
/// Resting soil may sleep. A tile of particles (state/tileGrid.hpp: 16 x 16 or 8 x 8 x 8 cells) that has been quiet for
/// a while takes no part in the step until something disturbs it: its particles stay where they are with the stress
/// they have, and what they project, mass and internal forces, is kept. Nodes that no tile awake reaches are not
/// solved.
///
///     rest                        // system/mpmSchemes; absent: nothing sleeps
///     {
///         tolerance   1e-6;       // eps [-], > 0: strain of the waves that may be ignored
///         looks       5;          // looks in a row at which a tile has to be quiet, >= 1; default 5
///         follow      no;         // yes: what sleeps follows slow motion, see below; default no
///     }
///
/// A plane wave of strain eps carries the velocity eps c_p and the stress eps M, M = rho c_p^2 (the material with the
/// slowest wave counts).
///     falls asleep   when at `looks` looks in a row, one every sortInterval steps, no node its particles reach showed
///                    half of what wakes; in the first step of a run, when no particle moves at all
///     wakes          in the very step in which at a node its particles reach
///                        |v*| > eps c_p   or   |a| h > eps c_p^2,   v* and a of the nodal equation:
///                    a wave stronger than eps arrives, or a stress of more than eps M is out of balance over a cell.
///                    Tiles beside a tile that wakes are judged in the same step, with the nodes it brings with it
///     is judged      at nodes it shares with tiles awake in every step, at all its nodes at every look, and in every
///                    step of a scene with loads
///     never sleeps   within two cells of something that moves as prescribed, nor while gravity grows
/// Tiles that share nodes with another body (nodal/contact.hpp) stay awake.
///
/// Nodes that sleeping particles share with others are held: what is awake meets a rigid body there, so that no strain
/// is lost to the border, however often soil falls asleep and wakes. So stresses out of balance inside what sleeps stay
/// below eps M, and StepReport::restingStress is the largest one left alone so far in a run. tolerance = 0 would let
/// sleep only what balances to the last bit; it is refused.
///
/// A load that grows slowly strains the ground as far as it reaches: rigid sleepers would have to wake for every eps M
/// of it, and bear up to eps M along all their border in between. With `follow yes` what sleeps keeps its velocities
/// and takes one long step at every look instead, over the K steps to the next (K = sortInterval), with an inertia K^2
/// times as large: dt/K f/m is added to v, K dt v to x, so the Courant number is what it is, and waves in what sleeps
/// are K times slower. Nodes it shares move with it. Motion slow against these waves is followed as it is; the error is
/// the force of the added inertia, (K^2 - 1) m a, which is what is out of balance over a cell:
///     falls asleep   at |a| h <= eps c_p^2 / (2 K), and moving by less than a twentieth of a cell from look to look
///     wakes          at |a| h > eps c_p^2, in the step after, moved on to the time at hand
/// So StepReport::restingStress <= eps M bounds it as above, and restLoss is the work it does. A particle that sleeps
/// is at most K steps behind, in files too. Walls that stand still hold what sleeps, friction sticks. Not with loads,
/// absorbing boundaries or steps that adapt.
///
/// What falling asleep takes from velocities, and the share of sleeping particles in the motion of nodes, are booked:
/// energies as restLoss and (between grid and particles) transferLoss, impulses as restImpulse. Who sleeps follows from
/// the particle column `quietLooks`, which a restart has. With FLIP; without treatments of stress and prescribed body
/// forces. Verified in tests/unit/rest.cpp, tests/verification/restingGround.
#include "base/types.hpp"

namespace mpm::stepping
{
struct Rest
{
    double tolerance = 1e-6; ///< eps [-]
    Index looks = 5;
    bool follow = false; ///< one long step a look instead of none

    static constexpr double quietShare = 0.5; ///< of what wakes: less is quiet
};

struct MotionOfSleepers
{
    double kinetic = 0; ///< [J]
    Vector3 momentum{}; ///< [N s]
};
} // namespace mpm::stepping
