// Formulas of a user: values, names, every mistake with its place and what is allowed, threads.
#include "dictionary/expression.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <thread>

using namespace mpm;
using namespace mpm::dictionary;
using namespace std::string_literals;

namespace
{
const std::vector<std::string> variables{"x", "y", "X", "Y", "t"};

Expression expression(const std::string& text, const Constants& constants = {})
{
    return Expression({text, {"constant/bodyForce", 4}}, "value", variables, constants);
}

double value(const std::string& text, const Constants& constants = {})
{
    return expression(text, constants).evaluate({2, 3, 0.25, 0.5, 0.1});
}

std::string message(const std::string& text, const Constants& constants = {})
{
    try
    {
        expression(text, constants);
    }
    catch (const InputError& error)
    {
        return error.what();
    }
    return "nothing";
}

std::string messageOfDictionary(const std::string& text, int dim = 2)
{
    try
    {
        const auto d = Dictionary::fromText(text, "constant/bodyForce");
        const auto constants = readConstants(d, variables);
        readVectorExpression(d, "value", "a force", unit::acceleration, dim, variables, constants, true);
        d.rejectUnread();
    }
    catch (const InputError& error)
    {
        return error.what();
    }
    return "nothing";
}
} // namespace

TEST_CASE("values of formulas, to the last bit those of C")
{
    CHECK(value("x + 2*y") == 8);
    CHECK(value("-2^2") == -4);
    CHECK(value("2^-1") == 0.5);
    CHECK(value("A*sin(pi*X)*cos(c*t)", {{"A", 0.05}, {"c", 100}}) ==
          0.05 * std::sin(std::numbers::pi * 0.25) * std::cos(100 * 0.1));
    CHECK(value("pi") == std::numbers::pi);
    CHECK(value("log(x)") == std::log(2.0));
    CHECK(value("ln(x)") == std::log(2.0));
    CHECK(value("x < y ? 7 : 1/0") == 7);
    CHECK(value("x == 2 && y >= 3 && x != y") == 1);
    CHECK(value("atan2(y, x)") == std::atan2(3.0, 2.0));
    CHECK(value("1e-3") == 1e-3);
    CHECK(value("-9.81") == -9.81);
    CHECK(Expression().evaluate({1, 2, 3, 4, 5}) == 0);
}

TEST_CASE("numbers and used variables are known")
{
    CHECK(expression("-9.81").number() == -9.81);
    CHECK_FALSE(expression("-9.81*t").number());
    const auto e = expression("sin(X)*t");
    CHECK(e.uses("X"));
    CHECK(e.uses("t"));
    CHECK_FALSE(e.uses("x"));
    CHECK(e.text() == "sin(X)*t");
    CHECK(e.where().text() == "constant/bodyForce:4");
}

TEST_CASE("every mistake is told with its place and what is allowed")
{
    const std::string start = "constant/bodyForce:4: value: found ";
    CHECK(message("2*expp(x)") == start + "'\"2*expp(x)\"', wrong at 'expp', an unknown name (did you mean 'exp'?); "
                                          "allowed x, y, X, Y, t, pi and functions, other names in constants { }");
    CHECK(message("amplitud*t", {{"amplitude", 1}})
              .find("(did you mean 'amplitude'?); allowed x, y, X, Y, t, pi, "
                    "amplitude and functions") != std::string::npos);
    CHECK(message("Z").find("wrong at 'Z', an unknown name") != std::string::npos); // 2D knows no Z
    CHECK(message("_pi").find("an unknown name") != std::string::npos);
    for (const std::string text : {"sin(x", "x +", "", "x y", "2 x", "sin()", "atan2(x)", "(x))", "x @ y", "\"x\"",
                                   "x;", "3..5", "x ? 1", "?:", "^"})
    {
        INFO(text);
        const auto found = message(text);
        CHECK(found.substr(0, start.size()) == start);
        CHECK(found.find("llowed") != std::string::npos);
    }
    CHECK(message("x = 3").find("with '=', allowed is a formula: it has a value and assigns none") !=
          std::string::npos);
    CHECK(message("x == 3") == "nothing");
    CHECK(message("x, y").find("2 values separated by ','; allowed is one") != std::string::npos);
    CHECK(message(std::string(1001, '1') + "+x").find("1003 characters; allowed are 1000") != std::string::npos);
    CHECK(message(std::string(499, '(') + "x" + std::string(499, ')')) == "nothing");
}

TEST_CASE("vectors of formulas in a dictionary, with constants")
{
    const auto d = Dictionary::fromText("value (\"A*sin(pi*X)\" 1e-3 0); constants { A 0.05; }");
    const auto v =
        readVectorExpression(d, "value", "", unit::acceleration, 2, variables, readConstants(d, variables), true);
    CHECK(v[0].evaluate({0, 0, 0.5, 0, 0}) == 0.05);
    CHECK(v[1].number() == 1e-3);
    CHECK_NOTHROW(d.rejectUnread());
    CHECK(messageOfDictionary("value (\"x\" 0);") == "nothing");
    CHECK(messageOfDictionary("value (\"x\" 0);", 3) ==
          "constant/bodyForce:1: value: found 2 components, allowed 3, (x y z), numbers or formulas in double quotes");
    CHECK(messageOfDictionary("value (0 0 \"x\");") ==
          "constant/bodyForce:1: value: found z component x, allowed 0 in 2D");
    CHECK(messageOfDictionary("value (0 0 1 2);").find("found 4 components") != std::string::npos);
    CHECK(messageOfDictionary("value 3;").find("allowed a list ( ... ) of numbers or formulas in double quotes") !=
          std::string::npos);
    CHECK(messageOfDictionary("value (1e999 0);").find("beyond double precision") != std::string::npos);
    CHECK(messageOfDictionary("value (0\n\"x y\" 0);").substr(0, 28) == "constant/bodyForce:2: value:");
    CHECK(messageOfDictionary("value (0 0); constants { x 1; }") ==
          "constant/bodyForce:1: constants.x: found a name that means something in formulas, allowed another name");
    CHECK(messageOfDictionary("value (0 0); constants { sin 1; }").find("another name") != std::string::npos);
    CHECK(messageOfDictionary("value (0 0); constants { pi 3; }").find("another name") != std::string::npos);
    CHECK(messageOfDictionary("value (0 0); constants { a-b 3; }").find("a name of letters") != std::string::npos);
    CHECK(messageOfDictionary("value (0 0); constants { A two; }")
              .find("1: constants.A: found '\"two\"', wrong at 'two', "
                    "an unknown name") != std::string::npos);
}

TEST_CASE("constants may be formulas of the variables and of those before them")
{
    const auto d =
        Dictionary::fromText("value (\"b*X/R\" \"b*Y/R\" 0);\nconstants { A 0.05; R \"sqrt(X^2 + Y^2)\"; late "
                             "\"A*t\"; s \"A*sin(pi*x)\"; b \"-s*R\"; }");
    const auto constants = readConstants(d, variables);
    const auto v = readVectorExpression(d, "value", "", unit::acceleration, 2, variables, constants, true);
    const double s = 0.05 * std::sin(std::numbers::pi * 2), R = std::sqrt(0.25 * 0.25 + 0.5 * 0.5);
    CHECK(v[0].evaluate({2, 3, 0.25, 0.5, 0.1}) == -s * R * 0.25 / R);
    CHECK(v[1].evaluate({2, 3, 0.25, 0.5, 0.1}) == -s * R * 0.5 / R);
    CHECK(v[0].uses("x"));
    CHECK(v[0].uses("Y"));       // in R
    CHECK_FALSE(v[0].uses("t")); // only `late` does
    CHECK_FALSE(v[0].uses("y"));
    CHECK(messageOfDictionary("value (\"B\" 0);\nconstants { A \"B + 1\";\nB 2; }").substr(0, 60) ==
          "constant/bodyForce:2: constants.A: found '\"B + 1\"', wrong at 'B', an unknown name"s.substr(0, 60));
    CHECK(messageOfDictionary("value (\"A\" 0); constants { A \"t +\"; }")
              .find("constants.A: found '\"t +\"', wrong at its "
                    "end") != std::string::npos);
}

TEST_CASE("the first value that is not finite is named, and threads get the same bits")
{
    const auto e = expression("sqrt(x)*exp(y)/t");
    std::vector<double> x(1000), y(1000), t(1000, 0.5), out(1000);
    for (std::size_t i = 0; i < 1000; ++i)
    {
        x[i] = 0.1 * double(i);
        y[i] = std::sin(double(i));
    }
    CHECK(e.evaluate({x.data(), y.data(), nullptr, nullptr, t.data()}, 1000, out.data()) == -1);
    std::vector<std::vector<double>> others(4, std::vector<double>(1000));
    std::vector<std::thread> threads;
    for (auto& other : others)
        threads.emplace_back([&] {
            for (Index first = 0; first < 1000; first += 50)
                e.evaluate({&x[std::size_t(first)], &y[std::size_t(first)], nullptr, nullptr, &t[std::size_t(first)]},
                           50, &other[std::size_t(first)]);
        });
    for (auto& thread : threads)
        thread.join();
    for (const auto& other : others)
        CHECK(other == out);
    for (std::size_t i = 0; i < 1000; ++i)
        CHECK(out[i] == Approx(std::sqrt(x[i]) * std::exp(y[i]) / t[i]).epsilon(1e-15));
    t[700] = 0;
    x[300] = -1;
    CHECK(e.evaluate({x.data(), y.data(), nullptr, nullptr, t.data()}, 1000, out.data()) == 300);
}
