// Dampers of a wheel on its reduced modes: Den Hartog's fixed points, absorbers against a ring, rings against masses in the
// finite elements of the section, layers against the whole loss.
#include "pi.h"

#include <vibrocontact/base/complex_dense.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/damped_wheel.h>
#include <vibrocontact/reduction/revolved_reduction.h>
#include <vibrocontact/scene/revolved_mesh.h>
#include <vibrocontact/scene/wheel.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  struct FreeWheel
  {
    std::shared_ptr<const RevolvedSection> section;
    RevolvedShapes shapes;
    ReducedBody body;
  };

  /// The shipped section with elements of second order, to 2500 Hz.
  FreeWheel free_wheel(const double upper_frequency = 2500)
  {
    run_log().set_screen(false);
    WheelParameters parameters;
    parameters.model = "harmonics";
    parameters.section.element_degree = 2;
    const std::vector<ContactPlace> none;
    const RevolvedMesh mesh = parameters.make_section({"wheel", 0., none, nullptr, {}, MPI_COMM_SELF});
    ElasticModel<3> model;
    model.held = {mesh.held};
    FreeWheel wheel;
    wheel.section = std::make_shared<RevolvedSection>("wheel", mesh.triangulation, model, mesh.degree);
    ModeParameters wanted;
    wanted.upper_frequency = upper_frequency;
    SurfaceShapes surface;
    const ModalReduction modes =
        RevolvedReduction(std::make_unique<RevolvedSection>("wheel", mesh.triangulation, model, mesh.degree),
                          "wheel", mesh.radius, 0., {}, MPI_COMM_SELF)
            .modes(wanted, WheelFrame(), surface, wheel.shapes);
    wheel.body.omega = modes.omega;
    wheel.body.damping_ratio.assign(modes.omega.size(), 0.);
    wheel.body.labels = modes.labels;
    wheel.body.participation = modes.participation;
    wheel.body.trace.reinit(0, modes.omega.size());
    return wheel;
  }

  WheelDamper on_rim(const std::string &kind, const double mass, const double frequency)
  {
    WheelDamper damper;
    damper.name = kind;
    damper.kind = kind;
    damper.mass = mass;
    damper.frequency = frequency;
    damper.axial = 0.06;
    damper.radius = 0.40;
    return damper;
  }

  /// A body of one mode that moves axially by 1/sqrt(mass).
  RevolvedShapes one_mode(const double omega, const double mass)
  {
    RevolvedShapes shapes;
    shapes.omega = {omega};
    shapes.waves = shapes.odd = {0};
    shapes.points = {0., 0.4};
    shapes.shapes = {1 / std::sqrt(mass), 0., 0.};
    shapes.cells = {0., 0.4, 0.};
    shapes.first = shapes.second = {0};
    shapes.energies = {omega * omega};
    return shapes;
  }
} // namespace

// At two frequencies what the mass answers does not depend on the absorber's loss; tuned to 1 / (1 + mu) both answers are
// sqrt(1 + 2 / mu) of the static one (Den Hartog 1956, ch. 3.3).
TEST(DampedWheel, FixedPointsOfDenHartog)
{
  const double w = 100, mass = 50, mu = 0.05, height = std::sqrt(1 + 2 / mu);
  const RevolvedShapes shapes = one_mode(w, mass);
  for (const double eta : {0., 0.1, 0.4, 2.})
  {
    WheelDamper absorber = on_rim("absorber", mu * mass, w / (1 + mu) / two_pi);
    absorber.axial = 0;
    absorber.loss_factor = eta;
    ReducedBody body;
    body.omega = {w};
    body.damping_ratio = {0.};
    body.labels = {"axial(0,0)"};
    body.participation.reinit(1, 3);
    body.trace.reinit(1, 1);
    body.trace(0, 0) = 1 / std::sqrt(mass);
    body = with_attached(body, attached_masses(shapes, {absorber}, "wheel/Wheel/Damper"));
    ASSERT_EQ(body.n_modes(), 2u);
    for (const double sign : {-1., 1.})
    {
      const double square = w * w * (1 + sign * std::sqrt(mu / (2 + mu))) / (1 + mu);
      ComplexMatrix K(2, 2);
      for (unsigned int j = 0; j < 2; ++j)
      {
        for (unsigned int i = 0; i < 2; ++i)
          K(i, j) = {0, body.loss(i, j)};
        K(j, j) += body.omega[j] * body.omega[j] - square;
      }
      dealii::Vector<std::complex<double>> q(2);
      q[0] = body.trace(0, 0);
      q[1] = body.trace(0, 1);
      K.compute_lu_factorization();
      K.solve(q);
      const std::complex<double> answer = body.trace(0, 0) * q[0] + body.trace(0, 1) * q[1];
      EXPECT_NEAR(std::abs(answer) * mass * w * w, height, 1e-9 * height) << "eta " << eta;
    }
  }
}

// Absorbers in sufficient number are a ring; nearly without mass they are nearly nothing.
TEST(DampedWheel, ManyAbsorbersAreARing)
{
  const FreeWheel wheel = free_wheel();
  const auto with = [&](const WheelDamper &damper)
  { return with_attached(wheel.body, attached_masses(wheel.shapes, {damper}, "wheel/Wheel/Damper")); };
  // a mass adds at most m b^T b to the mass of 1 that each mode has, and what m is worth on its spring
  const WheelDamper light = on_rim("absorber", 1e-9, 900);
  const ReducedBody nearly = with(light);
  ASSERT_EQ(nearly.n_modes(), wheel.body.n_modes() + 1);
  for (unsigned int k = 0; k < wheel.body.n_modes(); ++k)
  {
    double bound = 1e-12, nearest = 1e300;
    const double w = wheel.body.omega[k];
    for (const AttachedMass &one : attached_masses(wheel.shapes, {light}, "wheel/Wheel/Damper"))
    {
      double square = 0;
      for (const double b : one.motion)
        square += b * b;
      bound += one.mass * square / (one.is_sprung() ? std::abs(1 - w * w / (one.omega * one.omega)) : 1);
    }
    for (const double other : nearly.omega)
      nearest = std::min(nearest, std::abs(other - w));
    EXPECT_LT(nearest, bound * w) << wheel.body.labels[k];
  }
  const unsigned int number = 16;
  for (const double frequency : {0., 900.})
  {
    WheelDamper absorbers = on_rim("absorber", 10. / number, frequency), ring = on_rim("ring", 10, frequency);
    absorbers.number = number;
    absorbers.loss_factor = ring.loss_factor = 0.2;
    const ReducedBody one = with(absorbers), other = with(ring);
    // of the ring there are masses for waves in which the wheel has no mode, and as many absorbers as there are
    for (unsigned int k = 0; k < wheel.body.n_modes(); ++k)
    {
      const auto place = [&](const ReducedBody &body) {
        return std::find(body.labels.begin(), body.labels.end(), wheel.body.labels[k]) - body.labels.begin();
      };
      const unsigned int i = place(one), j = place(other);
      ASSERT_LT(i, one.n_modes());
      ASSERT_LT(j, other.n_modes());
      EXPECT_NEAR(one.omega[i], other.omega[j], 1e-8 * other.omega[j]) << wheel.body.labels[k];
      EXPECT_NEAR(one.damping_ratio[i], other.damping_ratio[j], 1e-8) << wheel.body.labels[k];
      if (frequency == 0)
        EXPECT_LT(one.omega[i], wheel.body.omega[k]);
    }
  }
  WheelDamper off = on_rim("absorber", 1, 900);
  off.radius = 0.6;
  EXPECT_THROW(with(off), InputError);
}

// At its frequency a sprung mass is a fixed one of m / (1 - w^2 / w_a^2): with that in the finite elements of the section
// the eigenproblem of n waves has the same frequency, as far as modes to 8 kHz follow a mass at one point.
TEST(DampedWheel, RingInTheElementsOfTheSection)
{
  const FreeWheel wheel = free_wheel(8000);
  const RevolvedSection::Boundary boundary = wheel.section->boundary(0);
  for (const double frequency : {0., 1300.})
  {
    const double mass = 8;
    WheelDamper ring = on_rim("ring", mass, frequency);
    const ReducedBody damped =
        with_attached(wheel.body, attached_masses(wheel.shapes, {ring}, "wheel/Wheel/Damper"));
    unsigned int point = 0;
    for (unsigned int i = 0; i < boundary.points.size(); ++i)
      if (boundary.points[i].distance({ring.axial, ring.radius}) <
          boundary.points[point].distance({ring.axial, ring.radius}))
        point = i;
    for (const std::string label : {"axial(0,2)", "axial(0,3)", "axial(0,0)"})
    {
      const unsigned int k =
          std::find(damped.labels.begin(), damped.labels.end(), label) - damped.labels.begin();
      ASSERT_LT(k, damped.n_modes());
      const double w = damped.omega[k], w_a = two_pi * frequency;
      const unsigned int n = label.back() == ')' ? label[label.size() - 2] - '0' : 0;
      const auto system = wheel.section->system(n);
      for (unsigned int c = 0; c < 3; ++c)
      {
        const unsigned int dof = wheel.section->boundary(n).rows[3 * point + c].front().first;
        const double moved = frequency > 0 && c == 0 ? mass / (1 - w * w / (w_a * w_a)) : mass;
        system->mass.add(dof, dof, n == 0 ? moved : moved / 2);
      }
      system->mass.compress(dealii::VectorOperation::add);
      Flexibility flexibility(*system);
      ModeParameters wanted;
      wanted.count = 8;
      const Modes modes = compute_modes(*system, flexibility, wanted);
      double nearest = 1e300;
      for (const double other : modes.omega)
        if (std::abs(other - w) < std::abs(nearest - w))
          nearest = other;
      EXPECT_NEAR(nearest, w, 2e-4 * w) << label << " with a ring tuned to " << frequency << " Hz";
      RecordProperty(label + (frequency > 0 ? " sprung" : " fixed"), std::to_string(nearest / w - 1));
    }
  }
}

// Energies of the elements add up to those of the modes; a layer over all of the wheel is a loss factor.
TEST(DampedWheel, Layers)
{
  const FreeWheel wheel = free_wheel();
  WheelDamper inside = on_rim("layer", 0, 0), outside = inside;
  inside.loss_factor = outside.loss_factor = 0.02;
  inside.outer_radius = outside.inner_radius = 0.3;
  const auto loss_of = [&](const std::vector<WheelDamper> &layers)
  { return loss_of_parts(wheel.shapes, loss_of_layers(wheel.shapes, layers, "wheel/Wheel/Damper")); };
  const DenseMatrix both = loss_of({inside, outside}), one = loss_of({inside});
  double coupling = 0;
  for (unsigned int k = 0; k < wheel.body.n_modes(); ++k)
    for (unsigned int l = 0; l < wheel.body.n_modes(); ++l)
    {
      const double scale = 0.02 * wheel.body.omega[k] * wheel.body.omega[l];
      EXPECT_NEAR(both(k, l), k == l ? scale : 0, 1e-8 * scale);
      if (k != l)
        coupling = std::max(coupling, std::abs(one(k, l)) / scale);
      else
      {
        EXPECT_GT(one(k, k), 0);
        EXPECT_LT(one(k, k), scale);
      }
    }
  EXPECT_GT(coupling, 0.01);
  ReducedBody body = wheel.body;
  add_loss(body, both);
  EXPECT_EQ(body.loss.m(), 0u);
  EXPECT_NEAR(body.damping_ratio[3], 0.01, 1e-9);
}
