#pragma once
/// The ledger's entries with their names in state.h5 and their units in 3D (in 2D all but counts are per metre).
#include "state/state.hpp"

#include <string>

namespace mpm::output
{
/// Calls visit(name, value, unit) for every entry; value is a double, an Index or a Vector3.
template <class Ledger, class Visitor>
void forEachLedgerEntry(Ledger& ledger, Visitor&& visit)
{
    visit("plasticDissipation", ledger.plasticDissipation, "J");
    visit("frictionDissipation", ledger.frictionDissipation, "J");
    visit("wallLoss", ledger.wallLoss, "J");
    visit("contactFriction", ledger.contactFriction, "J");
    visit("contactLoss", ledger.contactLoss, "J");
    visit("splitMergeLoss", ledger.splitMergeLoss, "J");
    visit("transferLoss", ledger.transferLoss, "J");
    visit("dampingDissipation", ledger.dampingDissipation, "J");
    visit("pendingWork", ledger.pendingWork, "J");
    visit("staggering", ledger.staggering, "J");
    visit("initialStaggering", ledger.initialStaggering, "J");
    visit("finiteStrainWork", ledger.finiteStrainWork, "J");
    visit("relaxationLoss", ledger.relaxationLoss, "J");
    visit("averagingLoss", ledger.averagingLoss, "J");
    visit("viscosityLoss", ledger.viscosityLoss, "J");
    visit("bulkViscosityLoss", ledger.bulkViscosityLoss, "J");
    visit("gapWork", ledger.gapWork, "J");
    visit("restLoss", ledger.restLoss, "J");
    visit("gravityWork", ledger.gravityWork, "J");
    visit("tractionWork", ledger.tractionWork, "J");
    visit("motionWork", ledger.motionWork, "J");
    visit("motionSupply", ledger.motionSupply, "J");
    visit("absorbedEnergy", ledger.absorbedEnergy, "J");
    visit("apexVolume", ledger.apexVolume, "m^3");
    visit("bodyForceWork", ledger.bodyForceWork, "J");
    visit("kineticEnergy", ledger.kineticEnergy, "J");
    visit("initialKineticEnergy", ledger.initialKineticEnergy, "J");
    visit("initialStrainEnergy", ledger.initialStrainEnergy, "J");
    visit("wallImpulse", ledger.wallImpulse, "N s");
    visit("gravityImpulse", ledger.gravityImpulse, "N s");
    visit("tractionImpulse", ledger.tractionImpulse, "N s");
    visit("dampingImpulse", ledger.dampingImpulse, "N s");
    visit("restImpulse", ledger.restImpulse, "N s");
    visit("initialMomentum", ledger.initialMomentum, "N s");
    visit("splitAngularMomentum", ledger.splitAngularMomentum, "kg m^2/s");
    visit("apexReturns", ledger.apexReturns, "1");
    visit("splits", ledger.splits, "1");
    visit("merges", ledger.merges, "1");
    visit("splitsPutOff", ledger.splitsPutOff, "1");
    visit("splitsCapped", ledger.splitsCapped, "1");
    visit("restingSteps", ledger.restingSteps, "1");
    visit("wakes", ledger.wakes, "1");
    visit("bodyContacts", ledger.bodyContacts, "1");
    visit("wallContacts", ledger.wallContacts, "1");
    visit("contactNodes", ledger.contactNodes, "1");

    static_assert(sizeof(state::Ledger) == 57 * 8,
                  "a member of Ledger was added or removed: list it above, or a restart would lose it");
}
} // namespace mpm::output
