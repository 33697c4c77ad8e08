// Bodies of law rigid: they go where they are told, exactly, and push and drag others as an infinite mass.
#include "base/error.hpp"
#include "case/readContact.hpp"
#include "constitutive/rigid.hpp"
#include "support/bodies.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace bodies;
using Catch::Contains;

namespace
{
std::shared_ptr<const nodal::RigidMotion> motionFrom(const std::string& text)
{
    const auto d = dictionary::Dictionary::fromText(text, "motion");
    return std::make_shared<const nodal::RigidMotion>(nodal::RigidMotion::read(d, 2, {}));
}

/// Body 1 is rigid.
stepping::Scene rigidScene(double mu, const std::string& motion, stepping::StressUpdate update)
{
    auto scene = sceneOf(2, mu);
    scene.stressUpdate = update;
    scene.materials[1].law = std::make_shared<constitutive::Rigid>();
    scene.contact->motion = {nullptr, motionFrom(motion)};
    return scene;
}

const std::array<Index, 3> cells{40, 20, 1};
} // namespace

TEST_CASE("a rigid body turns without changing its shape, and no energy is unaccounted for")
{
    for (const auto update : updates)
    {
        CAPTURE(int(update));
        auto s = join({{{.corner = {0.2, 0.2, 0}, .n = {4, 4, 1}, .spacing = 0.05, .h = 0.1, .cells = cells}, 0},
                       {{.corner = {2, 0.7, 0}, .n = {16, 8, 1}, .spacing = 0.05, .h = 0.1, .cells = cells}, 1}});
        const auto before = s.particles;
        const auto scene =
            rigidScene(0, "velocity (0.2 0 0); rotation { centre (2.4 0.9 0); angularVelocity 1.5; }", update);
        const double residual = run(s, scene, 200, 5e-3);
        const auto start = [&](std::int64_t id) {
            for (std::size_t i = 0; i < std::size_t(before.size()); ++i)
                if (before.id[i] == id)
                    return Vector3{before.x[0][i] - 2.4, before.x[1][i] - 0.9, 0};
            return Vector3{};
        };
        double off = 0, stretched = 0;
        const double c = std::cos(1.5), sine = std::sin(1.5);
        for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
            if (s.particles.material[i] == 1)
            {
                const auto X = start(s.particles.id[i]);
                off = std::max({off, std::abs(s.particles.x[0][i] - (2.6 + c * X[0] - sine * X[1])),
                                std::abs(s.particles.x[1][i] - (0.9 + sine * X[0] + c * X[1]))});
                stretched = std::max(stretched, std::abs(s.particles.volume[i] / s.particles.volume0[i] - 1));
                CHECK(s.particles.stress[0][i] == 0);
            }
        CHECK(off < 1e-11);
        // USF takes strains over the middle of a step, but not the motion: (omega dt)^2 a step and axis
        CHECK(stretched < (update == stepping::StressUpdate::USF ? 2.2 * 200 * 0.0075 * 0.0075 : 1e-10));
        CHECK(std::abs(residual) < 1e-12 * s.ledger.kineticEnergy);
        CHECK(s.ledger.motionWork > 0);
    }
}

TEST_CASE("a rigid piston throws a bar ahead at twice its speed")
{
    // 1D theory: an elastic bar at rest, hit by an infinite mass at V, leaves with 2 V after 2 L/c.
    for (const auto update : updates)
    {
        CAPTURE(int(update));
        auto s =
            join({{{.corner = {1.51, 0.8, 0}, .n = {40, 8, 1}, .spacing = 0.025, .h = 0.05, .cells = {80, 40, 1}}, 0},
                  {{.corner = {1, 0.8, 0}, .n = {20, 8, 1}, .spacing = 0.025, .h = 0.05, .cells = {80, 40, 1}}, 1}});
        const auto scene = rigidScene(0, "velocity (0.1 0 0);", update);
        const double residual = run(s, scene, 400, 5e-4); // they meet at 0.1 s
        const auto bar = motionOf(s, 0), piston = motionOf(s, 1);
        CHECK(bar.velocity[0] == Approx(0.2).epsilon(0.08));
        CHECK(piston.velocity[0] == Approx(0.1).epsilon(1e-9));
        CHECK(piston.centre[0] == Approx(1.25 + 0.1 * s.time).epsilon(1e-12));
        CHECK(std::abs(residual) < 1e-12 * s.ledger.motionWork);
        // momentum of both: what drives the piston gave it
        const double given = bar.mass * bar.velocity[0] + piston.mass * piston.velocity[0];
        CHECK(s.ledger.wallImpulse[0] == Approx(given).epsilon(1e-12));
    }
}

TEST_CASE("a rigid slab that slides away drags what lies on it by friction")
{
    for (const auto update : updates)
    {
        CAPTURE(int(update));
        auto s = join({{{.corner = {1.5, 0.55, 0}, .n = {16, 8, 1}, .spacing = 0.05, .h = 0.1, .cells = cells}, 0},
                       {{.corner = {0.5, 0.2, 0}, .n = {60, 7, 1}, .spacing = 0.05, .h = 0.1, .cells = cells}, 1}});
        auto scene = rigidScene(0.2, "velocity (1 0 0);", update);
        scene.gravity = Vector3{0, -9.8, 0};
        const double residual = run(s, scene, 400, 5e-4);
        const auto m = motionOf(s, 0);
        const double press = m.mass * (9.8 * s.time + m.velocity[1]);
        CHECK(m.mass * m.velocity[0] == Approx(0.2 * press).epsilon(0.01));
        CHECK(motionOf(s, 1).velocity[1] == Approx(0).margin(1e-14));
        CHECK(std::abs(residual) < 1e-11 * s.ledger.motionWork);
        CHECK(s.ledger.contactFriction > 0);
    }
}

TEST_CASE("a rigid material is a body of its own, and says how it moves")
{
    const auto read = [](const std::string& contact, const std::string& motion) {
        const auto d = dictionary::Dictionary::fromText(
            "soil { law linearElastic; E 1e6; nu 0; } blade { law rigid; motion { " + motion + " } }", "materials");
        std::vector<constitutive::Material> materials;
        for (const auto& name : d.dictNames())
            materials.push_back({name, 1000, constitutive::makeLaw(d.subDict(name))});
        if (contact.empty())
        {
            cases::readRigidMotions(d, materials, 2, nullptr);
            return nodal::ContactProperties{};
        }
        auto out = cases::readContact(dictionary::Dictionary::fromText(contact, "contact"), materials);
        cases::readRigidMotions(d, materials, 2, &out);
        return out;
    };
    const auto good = read("bodies (blade); mu 0.3;", "velocity (0.1 0 0);");
    CHECK(good.bodies == std::vector<std::string>{"blade", "the rest"});
    CHECK(good.motion[0]);
    CHECK(!good.motion[1]);
    CHECK_THROWS_WITH(read("", "velocity (1 0 0);"), Contains("contactProperties"));
    CHECK_THROWS_WITH(read("bodies (blade); mu 0.3;", "rotation { angularVelocity 1; }"), Contains("centre"));
}
