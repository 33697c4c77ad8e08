// Prescribed functions of time: tables and their integrals exactly, formulas against closed forms, and what is wrong.
#include "dictionary/motion.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <thread>

using namespace mpm;
using namespace mpm::dictionary;
using Catch::Contains;

namespace
{
Motion motion(const std::string& text, int dim = 2)
{
    return Motion::read(Dictionary::fromText(text, "motion"), dim);
}
} // namespace

TEST_CASE("a constant velocity goes V t, bit by bit the same in every step")
{
    const auto m = motion("velocity (0.1 -2 0);");
    CHECK(m.displacement(3.0)[0] == Approx(0.3).epsilon(1e-15));
    CHECK(m.meanVelocity(1e6, 1e-6)[1] == -2);
    CHECK_FALSE(m.still());
    CHECK(m.stillAlong(2));
    CHECK(motion("velocity (0 0 0);").still());
    CHECK(motion("displacement (3 0 0);").still()); // counted from t = 0
}

TEST_CASE("tables are straight lines, their integrals parabolas and cubics")
{
    // v: 0 at 1 s, 2 at 2 s, held: x = (t - 1)^2 up to 2 s, then 1 + 2 (t - 2)
    const auto v = motion("velocity table ((1 (0 0 0)) (2 (2 0 0)));");
    CHECK(v.displacement(0.5)[0] == 0);
    CHECK(v.displacement(1.5)[0] == Approx(0.25).epsilon(1e-14));
    CHECK(v.displacement(4)[0] == Approx(5).epsilon(1e-14));
    CHECK(v.meanVelocity(0.75, 0.5)[0] == Approx(0.0625 / 0.5).epsilon(1e-14)); // over a corner
    // a: 6 (1 - t) for 1 s, then none: v = 6 t - 3 t^2 -> 3, x = 3 t^2 - t^3 -> 2, then 2 + 3 (t - 1)
    const auto a = motion("acceleration ((0 (6 0)) (1 (0 0)));");
    for (const double t : {0.1, 0.5, 0.9, 1.0})
    {
        CHECK(a.velocity(t)[0] == Approx(6 * t - 3 * t * t).epsilon(1e-14));
        CHECK(a.displacement(t)[0] == Approx(3 * t * t - t * t * t).epsilon(1e-14));
    }
    CHECK(a.velocity(7)[0] == Approx(3).epsilon(1e-14));
    CHECK(a.displacement(7)[0] == Approx(20).epsilon(1e-14));
    CHECK(motion("acceleration ((0 (6 0)) (1 (6 0)));").velocity(5)[0] == Approx(6).epsilon(1e-14)); // over after 1 s
    // a table that begins before t = 0: displacement counts from t = 0
    const auto early = motion("velocity ((-1 (1 0)) (1 (3 0)));");
    CHECK(early.displacement(0)[0] == 0);
    CHECK(early.displacement(1)[0] == Approx(2.5).epsilon(1e-14));
    const auto d = motion("displacement ((0 (1 0)) (2 (2 0)));");
    CHECK(d.displacement(1)[0] == Approx(0.5).epsilon(1e-14));
    CHECK(d.velocity(1)[0] == Approx(0.5).epsilon(1e-14));
    CHECK(d.velocity(3)[0] == 0);
}

TEST_CASE("formulas are integrated to round-off over any time, and jumps are found")
{
    const double w = 2 * M_PI * 3;
    const auto v = motion("velocity (\"A*sin(w*t)\" 0 0); constants { A 0.2; w 18.849555921538759; }");
    const auto a = motion("acceleration (\"A*w*cos(w*t)\" 0 0); constants { A 0.2; w 18.849555921538759; }");
    const auto d = motion("displacement (\"A*(1 - cos(w*t))/w\" 0 0); constants { A 0.2; w 18.849555921538759; }");
    for (const double t : {1e-10, 1e-5, 0.01, 0.4, 1.0, 7.77, 40.0})
    {
        const double x = 0.2 * (1 - std::cos(w * t)) / w;
        for (const auto* m : {&v, &a, &d})
        {
            CHECK(m->displacement(t)[0] == Approx(x).margin(1e-12));
            CHECK(m->velocity(t)[0] == Approx(0.2 * std::sin(w * t)).margin(1e-8));
            const double mean = (0.2 * (1 - std::cos(w * (t + 1e-3))) / w - x) / 1e-3;
            CHECK(m->meanVelocity(t, 1e-3)[0] == Approx(mean).margin(1e-11));
        }
    }
    const auto pulse = motion("velocity (\"t > 0.3003 && t < 0.3004 ? 1 : 0\" 0 0);");
    CHECK(pulse.displacement(2)[0] == Approx(1e-4).epsilon(0.01));
    const auto fast = motion("velocity (\"t < 1e-7 ? 1 : 0\" 0 0);"); // a pulse right at the start
    CHECK(fast.displacement(1)[0] == Approx(1e-7).epsilon(0.01));
}

TEST_CASE("integrals do not depend on what was asked before, nor on who asks")
{
    const std::string text = "velocity (\"exp(-t)*sin(20*t)\" 0 0);";
    const auto forward = motion(text), backward = motion(text), shared = motion(text);
    std::vector<double> times;
    for (int i = 0; i < 400; ++i)
        times.push_back(0.0101 * i);
    std::vector<double> one, other(400), threaded(400);
    for (const double t : times)
        one.push_back(forward.displacement(t)[0]);
    for (std::size_t i = times.size(); i-- > 0;)
        other[i] = backward.displacement(times[i])[0];
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < 4; ++k)
        threads.emplace_back([&, k] {
            for (std::size_t i = k; i < times.size(); i += 4)
                threaded[i] = shared.displacement(times[i])[0];
        });
    for (auto& thread : threads)
        thread.join();
    CHECK(one == other);
    CHECK(one == threaded);
}

TEST_CASE("a CSV file of the case: one column along a direction, or components")
{
    const auto folder = std::filesystem::temp_directory_path() / "mpmTimeFunction";
    std::filesystem::create_directories(folder / "constant");
    std::ofstream(folder / "constant/quake.csv") << "# a record\nt [s],a [g]\n0,0\n1,0.5\n2,0\n";
    std::ofstream(folder / "constant/two.csv") << "t,x,y\n0,1,2\n1,3,4\n";
    std::ofstream(folder / "constant/bad.csv") << "t,x,y\n0,1,2\n0,3,4\n";
    const auto read = [&](const std::string& text) {
        std::ofstream(folder / "constant/boundaryConditions") << text;
        return Motion::read(Dictionary::readFile(folder / "constant/boundaryConditions"), 2);
    };
    const auto quake = read("acceleration { file \"constant/quake.csv\"; direction (0 2 0); scale 10; }");
    CHECK(quake.velocity(2)[1] == Approx(10).epsilon(1e-14)); // 0.5 * 2 * 10 over a triangle of 2 s
    CHECK(quake.velocity(2)[0] == 0);
    CHECK(read("velocity { file \"constant/two.csv\"; }").velocity(0.5)[1] == Approx(3));
    CHECK_THROWS_WITH(read("velocity { file \"constant/quake.csv\"; }"), Contains("direction"));
    CHECK_THROWS_WITH(read("velocity { file \"constant/two.csv\"; direction (1 0 0); }"), Contains("direction"));
    CHECK_THROWS_WITH(read("velocity { file \"constant/none.csv\"; }"), Contains("no such file"));
    CHECK_THROWS_WITH(read("velocity { file \"../two.csv\"; }"), Contains("outside the case folder"));
    CHECK_THROWS_WITH(read("velocity { file \"constant/bad.csv\"; }"), Contains("bad.csv:3") && Contains("rise"));
    std::filesystem::remove_all(folder);
}

TEST_CASE("angles are numbers")
{
    const auto read = [](const std::string& text) { return readAngle(Dictionary::fromText(text, "rotation")); };
    CHECK(read("angularVelocity 2;").displacement(3)[0] == Approx(6));
    CHECK(read("angle \"sin(t)\";").velocity(0)[0] == Approx(1).epsilon(1e-8));
    CHECK(read("angularAcceleration table ((0 1) (10 1));").displacement(2)[0] == Approx(2).epsilon(1e-14));
    CHECK_THROWS_WITH(read("angle ((0 (1 2)));"), Contains("one"));
}

TEST_CASE("mistakes are named with file and line")
{
    CHECK_THROWS_WITH(motion("\nvelocity (1 0 0); displacement (0 0 0);"), Contains("motion:2") && Contains("one of"));
    CHECK_THROWS_WITH(motion(""), Contains("found no motion"));
    CHECK_THROWS_WITH(motion("velocity (0 \"sin(x)\" 0);"), Contains("'x'"));
    CHECK_THROWS_WITH(motion("velocity (\"1/t\" 0 0);"), Contains("not finite at t = 0"));
    CHECK_THROWS_WITH(motion("velocity (0 0 1);"), Contains("0 in 2D"));
    CHECK_NOTHROW(motion("velocity (0 0 1);", 3));
    CHECK_THROWS_WITH(motion("velocity ((0 (1 0)) \n(1 (1 0 3)));"), Contains("motion:2") && Contains("z component"));
    CHECK_THROWS_WITH(motion("velocity ((1 (1 0)) (0 (1 0)));"), Contains("times that rise"));
    CHECK_THROWS_WITH(motion("velocity table ();"), Contains("rows"));
    CHECK_THROWS_WITH(motion("velocity ((0 1) (1 2));"), Contains("values"));
    CHECK_THROWS_WITH(motion("velocity ((0 ()));"), Contains("rows"));
    const auto later = motion("velocity (\"t < 1 ? t : 1/0\" 0 0);");
    CHECK_THROWS_AS(later.displacement(1.5), StepError);
}
