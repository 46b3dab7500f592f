#include "reach/affine_part.hpp"

#include <gtest/gtest.h>

#include "reach/matrix_exponential.hpp"
#include "support/read_system.hpp"

namespace coordreq {
namespace {

/// States x, y, z; inputs u, v; a disturbance w.
SystemSpec affine_problem(const std::string& time, const std::string& x, const std::string& y,
                          const std::string& z, const std::string& edges_of_z = "unsafe") {
  return read_system(R"({"coordreq": 1, "name": "t",
"states": [{"name": "x", "lower": -1, "upper": 1, "step": 0.5}, {"name": "y", "lower": -1, "upper": 1, "step": 0.5},
           {"name": "z", "lower": -1, "upper": 1, "count": 4, "outside": ")" +
                         edges_of_z + R"("}],
"inputs": [{"name": "u", "values": [-1, 2]}, {"name": "v", "values": [-1, 2]}],
"disturbances": [{"name": "w", "lower": -1, "upper": 1}],
"agents": [{"name": "a", "inputs": ["u", "v"]}],
"dynamics": {"time": ")" +
                         time + R"(", "period": 0.5, "equations": {"x": ")" + x + R"(", "y": ")" + y +
                         R"(", "z": ")" + z + R"("}}, "safe": "true"})",
                     "t");
}

using List = std::vector<std::int32_t>;

AffinePart part_of_x(const SystemSpec& spec) {
  return find_affine_part(spec, AffineDynamics(spec).dependencies(0), 0);
}

TEST(AffinePart, HoldsTheStatesThatCoefficientsOfInputsMultiply) {
  const AffinePart part = part_of_x(affine_problem("continuous", "u*y + cos(z)", "-u*x + v + w*z", "v"));
  EXPECT_EQ(part.states, (List{0, 1}));
  EXPECT_EQ(part.inputs, List{0});  // v is only added
}

TEST(AffinePart, LeavesOutWhatIsNotAffine) {
  const auto states = [](const std::string& time, const std::string& x, const std::string& y,
                         const std::string& z) { return part_of_x(affine_problem(time, x, y, z)).states; };
  EXPECT_EQ(states("continuous", "y*z", "x", "u"), List{});
  EXPECT_EQ(states("continuous", "w*y", "x", "u"), List{});
  EXPECT_EQ(states("continuous", "y + sin(x)", "x", "u"), List{});
  EXPECT_EQ(states("continuous", "if(x > 0, y, z)", "u", "u"), List{});
  EXPECT_EQ(states("continuous", "if(u > 0, y, 2*z)", "u", "u"), (List{0, 1, 2}));
  EXPECT_EQ(states("continuous", "y/(1 + u^2) - (z - x)", "x", "u"), (List{0, 1, 2}));
  EXPECT_EQ(states("continuous", "y^2 + z", "u", "u"), (List{0, 2}));
  // In continuous time what is not affine may not depend on what is: y comes back through z.
  EXPECT_EQ(states("continuous", "y + cos(z)", "u", "y"), List{0});
  EXPECT_EQ(states("discrete", "y + cos(z)", "u", "y"), List{1});
}

TEST(AffinePart, LeavesOutPeriodicAndStoppedStates) {
  EXPECT_EQ(part_of_x(affine_problem("continuous", "y + z", "u", "v", "periodic")).states, (List{0, 1}));
  EXPECT_EQ(part_of_x(affine_problem("continuous", "y + z", "u", "v", "unsafe")).states, (List{0, 1, 2}));
}

/// Phi against the exponential of the matrix in long double.
void expect_exponential(const SystemSpec& spec, double u, const Matrix& matrix, double width) {
  const AffinePart part = part_of_x(spec);
  ASSERT_EQ(part.states.size(), matrix.size());
  AffineCoefficients coefficients(spec, part, 0);
  coefficients.set(spec.input_slot(0), {u, u});
  ASSERT_TRUE(coefficients.enclose());
  const Matrix expected = exponential(matrix, spec.dynamics.period.get_d());
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = 0; j < matrix.size(); ++j) {
      const Interval& phi = coefficients.phi(i, j);
      const long double slack = 1e-17L * (1.0L + std::fabs(expected[i][j]));
      EXPECT_LE(phi.lower, expected[i][j] + slack);
      EXPECT_GE(phi.upper, expected[i][j] - slack);
      EXPECT_LE(phi.upper - phi.lower, width);
    }
  }
}

TEST(AffineCoefficients, AreTheExponentialOfTheMatrix) {
  const SystemSpec rotation = affine_problem("continuous", "u*y + cos(z)", "-u*x", "v");
  expect_exponential(rotation, 2, {{0, 2}, {-2, 0}}, 1e-14);
  expect_exponential(rotation, 0, {{0, 0}, {0, 0}}, 0);
  expect_exponential(affine_problem("continuous", "y - 3*x", "u*z + x - y", "0.5*y"), -1,
                     {{-3, 1, 0}, {1, -1, -1}, {0, 0.5, 0}}, 1e-14);
  // Squared several times.
  expect_exponential(affine_problem("continuous", "30*y - 40*x", "-90*y + u*x", "v"), 2,
                     {{-40, 30}, {2, -90}}, 1e-10);
}

TEST(AffineCoefficients, AreTheDerivativesOfAMap) {
  const SystemSpec spec = affine_problem("discrete", "0.5*x - u^2*y + sin(z)", "u", "v");
  const AffinePart part = part_of_x(spec);
  EXPECT_EQ(part.states, (List{0, 1}));
  AffineCoefficients coefficients(spec, part, 0);
  coefficients.set(spec.input_slot(0), {2, 2});
  ASSERT_TRUE(coefficients.enclose());
  EXPECT_EQ(coefficients.phi(0, 0).lower, 0.5);
  EXPECT_EQ(coefficients.phi(0, 0).upper, 0.5);
  EXPECT_EQ(coefficients.phi(0, 1).lower, -4);
  EXPECT_EQ(coefficients.phi(0, 1).upper, -4);
}

TEST(AffineCoefficients, WithoutBoundAreRefused) {
  const SystemSpec spec = affine_problem("continuous", "y/(u - 2)", "x", "v");
  AffineCoefficients coefficients(spec, part_of_x(spec), 0);
  coefficients.set(spec.input_slot(0), {2, 2});
  EXPECT_FALSE(coefficients.enclose());
  const SystemSpec far = affine_problem("continuous", "u*1e9*x + y", "x", "v");
  AffineCoefficients huge(far, part_of_x(far), 0);
  huge.set(far.input_slot(0), {2, 2});
  EXPECT_FALSE(huge.enclose());
}

}  // namespace
}  // namespace coordreq
