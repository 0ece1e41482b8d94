// Reduction: residual attachment responses with full vectors, static completeness, cache, ranks.

#include "matrix_difference.h"
#include "reduction_bodies.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/reduction/reduction_cache.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace vibrocontact;
using namespace reduction_test;

namespace
{
  Body block(const bool free, const MPI_Comm communicator, const bool with_load = false)
  {
    BlockParameters parameters;
    parameters.divisions_x = parameters.divisions_y = 3;
    parameters.divisions_z = 2;
    parameters.offset_x = 0.007;
    if (free)
      parameters.held.clear();
    ElasticModel<3> model;
    model.material.loss_factor = 0.02;
    if (with_load)
      model.gravity[2] = -9.81;
    return make_body(parameters, model, communicator, 6);
  }

  struct Parts
  {
    StaticReduction statics;
    ModalReduction modal;
    Modes modes;
  };

  Parts reduce(const Body &body, Flexibility &flexibility, const unsigned int count)
  {
    ModeParameters parameters;
    parameters.count = count;
    Parts parts;
    parts.statics = reduce_statically(*body.system, flexibility);
    parts.modal = reduce_modally(*body.system, flexibility, parameters, {}, &parts.modes);
    return parts;
  }

  /// Psi_e diag(w_e^-2) Psi_e^T
  DenseMatrix modal_flexibility(const ModalReduction &modal)
  {
    const unsigned int n = modal.trace.m();
    DenseMatrix result(n, n);
    for (unsigned int k = modal.n_rigid_modes; k < modal.omega.size(); ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          result(i, j) += modal.trace(i, k) * modal.trace(j, k) / (modal.omega[k] * modal.omega[k]);
    return result;
  }
} // namespace

TEST(ReductionMpi, ResidualResponsesAreOrthogonalAndComplete)
{
  for (const bool free : {false, true})
  {
    const Body body = block(free, MPI_COMM_WORLD, true);
    const auto &system = *body.system;
    Flexibility flexibility(system);
    const Parts parts = reduce(body, flexibility, 12);
    const ReducedBody reduced = combine(parts.statics, &parts.modal);
    const auto &modes = parts.modes;
    const unsigned int n_rows = system.trace.rows.size();

    // Full residual response to a contact force R and the body's load: G (P^T R + F) less the modes' part.
    std::vector<double> force(n_rows);
    dealii::PETScWrappers::MPI::Vector f(system.load), u(f), residual(f), product(f);
    for (unsigned int r = 0; r < n_rows; ++r)
    {
      force[r] = std::sin(1. + 3. * r);
      for (const auto &[dof, weight] : system.trace.rows[r])
        if (f.in_local_range(dof))
          f(dof) += 1e3 * force[r] * weight;
      f.compress(dealii::VectorOperation::add);
    }
    flexibility.vmult(u, f);
    residual = u;
    std::vector<double> q(modes.omega.size(), 0.);
    for (unsigned int k = modes.n_rigid_modes; k < q.size(); ++k)
    {
      q[k] = (modes.shapes[k] * f) / (modes.omega[k] * modes.omega[k]);
      residual.add(-q[k], modes.shapes[k]);
    }
    // Phi^T K Phi_s = 0, and Phi^T M Phi_s = 0
    system.stiffness.vmult(product, residual);
    for (const auto &phi : modes.shapes)
      EXPECT_LT(std::abs(phi * product), 1e-8 * phi.l2_norm() * f.l2_norm()) << free;
    system.mass.vmult(product, residual);
    for (const auto &phi : modes.shapes)
      EXPECT_LT(std::abs(phi * product), 1e-8 * phi.l2_norm() * product.l2_norm() + 1e-20) << free;

    // Reduced = full static response at the contact.
    const auto full = contact_trace(system.trace, u);
    double scale = 0;
    for (const double x : full)
      scale = std::max(scale, std::abs(x));
    for (unsigned int r = 0; r < n_rows; ++r)
    {
      double sum = reduced.residual_load[r];
      for (unsigned int c = 0; c < n_rows; ++c)
        sum += reduced.residual(r, c) * 1e3 * force[c];
      for (unsigned int k = reduced.n_rigid_modes; k < q.size(); ++k)
      {
        double generalised = reduced.modal_load[k];
        for (unsigned int c = 0; c < n_rows; ++c)
          generalised += reduced.trace(c, k) * 1e3 * force[c];
        sum += reduced.trace(r, k) * generalised / (reduced.omega[k] * reduced.omega[k]);
      }
      EXPECT_NEAR(sum, full[r], 1e-8 * scale) << free;
    }

    // Loss everywhere the same: zeta = eta / 2 of every elastic mode.
    for (unsigned int k = reduced.n_rigid_modes; k < reduced.omega.size(); ++k)
      EXPECT_NEAR(reduced.damping_ratio[k], 0.01, 1e-8);

    DenseMatrix compliance = reduced.residual;
    const auto add_modes = [&]
    { add_modal_compliance(compliance, reduced.trace, reduced.omega, reduced.name); };
    if (free)
      EXPECT_THROW(add_modes(), InputError);
    else
    {
      add_modes();
      EXPECT_LT(difference(compliance, parts.statics.compliance), 1e-12);
    }
    EXPECT_EQ(reduced.lifting[0], free ? 0. : 1.);
    EXPECT_EQ(reduced.lifting[n_rows - 1], 0.);
  }
}

TEST(ReductionMpi, AllModesLeaveNothing)
{
  // With more and more modes the residual flexibility falls towards zero.
  const Body body = block(false, MPI_COMM_WORLD);
  Flexibility flexibility(*body.system);
  double last = 1e300;
  for (const unsigned int count : {1u, 20u, 200u})
  {
    const Parts parts = reduce(body, flexibility, count);
    const ReducedBody reduced = combine(parts.statics, &parts.modal);
    double trace = 0;
    for (unsigned int i = 0; i < reduced.residual.m(); ++i)
      trace += reduced.residual(i, i);
    EXPECT_GT(trace, 0.);
    EXPECT_LT(trace, last);
    last = trace;
  }
}

TEST(ReductionMpi, TwoRanksAsOne)
{
  for (const bool free : {false, true})
  {
    const Body together = block(free, MPI_COMM_WORLD), alone = block(free, MPI_COMM_SELF);
    Flexibility a(*together.system), b(*alone.system);
    const Parts p = reduce(together, a, 15), q = reduce(alone, b, 15);
    ASSERT_EQ(p.modal.omega.size(), q.modal.omega.size());
    for (unsigned int k = p.modal.n_rigid_modes; k < p.modal.omega.size(); ++k)
      EXPECT_NEAR(p.modal.omega[k] / q.modal.omega[k], 1., 1e-9);
    EXPECT_LT(difference(p.statics.compliance, q.statics.compliance), 1e-9);
    EXPECT_LT(difference(modal_flexibility(p.modal), modal_flexibility(q.modal)), 1e-9);
    EXPECT_LT(difference(combine(p.statics, &p.modal).residual, combine(q.statics, &q.modal).residual), 1e-9);
  }
}

TEST(ReductionMpi, RanksWithoutCells)
{
  // One cell: on two ranks the second has no dofs, and everything comes out as on one.
  BlockParameters parameters;
  parameters.divisions_x = parameters.divisions_y = parameters.divisions_z = 1;
  ElasticModel<3> model;
  model.material.loss_factor = 0.02;
  model.gravity[2] = -9.81;
  for (const bool free : {false, true})
  {
    if (free)
      parameters.held.clear();
    const Body together = make_body(parameters, model, MPI_COMM_WORLD, 2),
               alone = make_body(parameters, model, MPI_COMM_SELF, 2);
    Flexibility a(*together.system), b(*alone.system);
    const Parts p = reduce(together, a, 4), q = reduce(alone, b, 4);
    ASSERT_EQ(p.modal.omega.size(), q.modal.omega.size());
    for (unsigned int k = p.modal.n_rigid_modes; k < p.modal.omega.size(); ++k)
      EXPECT_NEAR(p.modal.omega[k] / q.modal.omega[k], 1., 1e-9);
    EXPECT_LT(difference(p.statics.compliance, q.statics.compliance), 1e-9);
    EXPECT_LT(difference(combine(p.statics, &p.modal).residual, combine(q.statics, &q.modal).residual), 1e-8);
  }
}

TEST(ReductionMpi, CacheThatCannotBeWrittenIsAWarning)
{
  // A file stands where the folder should be: rank 0 alone fails, no rank waits for it.
  const std::string place =
      "no_folder_" + std::to_string(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
  const bool is_host = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  if (is_host)
    std::ofstream(place) << "a file";
  MPI_Barrier(MPI_COMM_WORLD);
  StaticReduction part;
  part.name = "block";
  const unsigned int warnings = run_log().n_warnings();
  const ReductionCache cache(place, MPI_COMM_WORLD);
  cache.save("a model", part);
  EXPECT_FALSE(cache.load_static("block", "a model").has_value());
  if (is_host)
  {
    EXPECT_GT(run_log().n_warnings(), warnings);
    std::filesystem::remove(place);
  }
}

TEST(ReductionMpi, CacheReturnsWhatWasSaved)
{
  const std::string folder =
      "reduction_cache_test_" + std::to_string(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
  const bool is_host = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  if (is_host)
    std::filesystem::remove_all(folder);
  MPI_Barrier(MPI_COMM_WORLD);
  const Body body = block(false, MPI_COMM_WORLD, true);
  Flexibility flexibility(*body.system);
  Parts parts = reduce(body, flexibility, 5);
  parts.statics.grid.traction = TractionShape::bilinear;

  const ReductionCache cache(folder, MPI_COMM_WORLD);
  EXPECT_FALSE(cache.load_static("block", "a model").has_value());
  cache.save("a model", parts.statics);
  cache.save("block", "a model", parts.modal);
  MPI_Barrier(MPI_COMM_WORLD);
  const auto statics = cache.load_static("block", "a model");
  const auto modal = cache.load_modal("block", "a model");
  ASSERT_TRUE(statics && modal);
  // bitwise
  EXPECT_EQ(difference(statics->compliance, parts.statics.compliance), 0.);
  EXPECT_EQ(statics->load_response, parts.statics.load_response);
  EXPECT_EQ(statics->lifting, parts.statics.lifting);
  EXPECT_EQ(statics->grid.n_x, parts.statics.grid.n_x);
  EXPECT_EQ(statics->grid.traction, TractionShape::bilinear);
  EXPECT_EQ(statics->grid.spacing_x, parts.statics.grid.spacing_x);
  EXPECT_EQ(modal->omega, parts.modal.omega);
  EXPECT_EQ(modal->labels, parts.modal.labels);
  EXPECT_EQ(modal->damping_ratio, parts.modal.damping_ratio);
  EXPECT_EQ(difference(modal->trace, parts.modal.trace), 0.);
  EXPECT_FALSE(cache.load_static("block", "another model").has_value());

  // A damaged file: one byte of the data changed, then cut short; a foreign one.
  const unsigned int warnings = run_log().n_warnings();
  const std::string file = cache.file_name("block", "static", "a model");
  const auto damage = [&](const auto &how)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (is_host)
      how();
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_FALSE(cache.load_static("block", "a model").has_value());
    cache.save("a model", parts.statics);
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_TRUE(cache.load_static("block", "a model").has_value());
  };
  damage(
      [&]
      {
        std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
        const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
        const double value = parts.statics.compliance(3, 3);
        const std::size_t place = bytes.find(std::string(reinterpret_cast<const char *>(&value), 8));
        ASSERT_NE(place, std::string::npos);
        stream.seekp(place + 2);
        stream.put(bytes[place + 2] ^ 0x40);
      });
  damage([&] { std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2); });
  damage([&] { std::ofstream(file) << "not HDF5"; });
  damage(
      [&]
      {
        cache.save("yet another model", parts.statics);
        std::filesystem::copy_file(cache.file_name("block", "static", "yet another model"), file,
                                   std::filesystem::copy_options::overwrite_existing);
      });
  if (is_host)
  {
    EXPECT_EQ(run_log().n_warnings(), warnings + 4);
    std::filesystem::remove_all(folder);
  }
}
