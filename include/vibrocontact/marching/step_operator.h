#pragma once

#include <vibrocontact/contact/contact_operator.h>
#include <vibrocontact/contact/creep.h>
#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/coupled_bodies/hub.h>
#include <vibrocontact/coupled_bodies/moving_shapes.h>
#include <vibrocontact/numerics/wide_loops.h>
#include <vibrocontact/propagators/modal_step.h>
#include <vibrocontact/propagators/step_weights.h>

#include <memory>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// What the contact problem of a time step is made of, on all points; constant as long as step and
  /// rolling speed are.
  struct StepMatrices : MovingShapes
  {
    PlacedContacts contacts;
    CreepScheme scheme;
    /// h [s], V [m/s]
    double step = 0, speed = 0;
    /// see ContactStepper
    double residual_theta = 1;
    /// that the rate of residual displacements is differenced over [s]
    double rate_step() const { return residual_theta * step; }
    /// and the time for which the last rate is taken to have gone on [s]
    double lead() const { return (1 - residual_theta) * step; }
    /// W~ over the step (rest_over_step()) [m/N] and the operator A of ContactStepper; 3 n square, empty of half-spaces alone
    DenseMatrix residual_flexibility, response;
    /// half-spaces alone: W~ and A by their kernels; null: by these matrices
    std::shared_ptr<const HalfSpaces> half_spaces;
    std::shared_ptr<const HalfSpaceOperator> half_space_response;
    /// what d/dx of W~ is beyond the differences between points; 3 n square [1/N] or empty
    DenseMatrix residual_gradient;
    /// right and left shapes of the poles in terms of the shapes, 2 Re beside -2 Im, so that states as Re z above Im z move
    /// the shapes by by_poles; rank x 2 n_poles
    DenseMatrix by_poles, into_poles;
    /// of the shapes, for a force at the end of the step: amplitudes diag(g1) amplitudes^T less what the dampers of
    /// the hub take, and 2 Re right diag(now) left^T, displacement [s^2/kg] and velocity [s/kg]; rank square
    DenseMatrix displacement_gain, velocity_gain;
  };

  /// @param steps one per mode; @param hub null: held @param pole_steps what the poles do in the step
  /// @param shapes shapes_of_steps(); null: they are found @param residual_theta see ContactStepper
  StepMatrices step_matrices(const CreepScheme &scheme, const ContactPair &pair,
                             const std::vector<ModalStep> &steps, double h, double speed,
                             const SuspendedHub *hub = nullptr, const StepWeights &pole_steps = {},
                             const PatchShapes *shapes = nullptr, double residual_theta = 1);

  /// Displacements [m] and velocities [m/s] of the shapes; rank each.
  struct MotionOfShapes
  {
    const DenseVector &displacement, &velocity;
  };

  /// A of a time step on some points of the grid, from the residual displacements w = W~ R there and upstream
  /// of them and from the few modal numbers c = basis^T R:
  ///
  ///   gap = w_n + (basis G c)_n,   slip = (V d/dx + 1 / rate_step()) w_t + V d/dx (basis G c)_t + (basis H c)_t
  ///
  /// (G, H: the gains of StepMatrices). y has w behind its 3 n_points() rows: who solves for R then has it
  /// too, without a second product.
  class StepOperator : public ContactOperator
  {
  public:
    /// @param points of the grid, ascending; the matrices have to outlive the operator
    StepOperator(const StepMatrices &matrices, std::vector<unsigned int> points);

    unsigned int n_points() const override { return nearby.size(); }
    void vmult(DenseVector &y, const DenseVector &R, const std::vector<unsigned int> &sources) const override;
    void vmult_change(DenseVector &y, const DenseVector &change,
                      const std::vector<unsigned int> &sources) const override;
    void extract(const std::vector<unsigned int> &points, DenseMatrix &block) const override;
    double mean_diagonal(unsigned int component) const override { return mean[component]; }
    double diagonal(const unsigned int component, const unsigned int point) const override
    {
      return diagonals.empty() ? mean[component] : diagonals[contact_row(n_points(), component, point)];
    }
    bool fast_product() const override { return matrices.half_spaces != nullptr; }

    /// the points of the grid, in the operator's order
    const std::vector<unsigned int> &points() const { return nearby; }
    /// rows of the grid whose residual displacements stand behind the 3 n_points() rows of y
    const std::vector<unsigned int> &residual_rows() const { return rows; }
    /// the points of the grid that are not among them, ascending
    const std::vector<unsigned int> &other_points() const { return others; }
    /// (W~ R)_n at the other points [m]
    void residual_gaps_of_others(const DenseVector &R, DenseVector &gaps) const;
    /// size of y
    unsigned int n_response_rows() const { return 3 * nearby.size() + rows.size(); }
    /// Whether d/dx of W~ is more than differences of the residual displacements in y.
    bool has_gradient() const { return matrices.residual_gradient.m() > 0; }
    /// Rows of each y for displacements and velocities of the shapes and the residual displacements that it already
    /// has behind them; of several motions the matrices are read once.
    void respond(const std::vector<MotionOfShapes> &motions, const std::vector<DenseVector *> &y) const;
    /// c = basis^T R of the normal (c_n) and of the tangential (c_t) forces; rank [N]
    void modal_numbers(const DenseVector &R, DenseVector &c_n, DenseVector &c_t) const;

  private:
    const StepMatrices &matrices;
    const std::vector<unsigned int> nearby;
    std::vector<unsigned int> others;
    std::vector<unsigned int> rows;
    /// points whose tangential residual displacements count: the nearby ones, those upstream and the next
    /// one downstream (for the energy account)
    unsigned int n_wet = 0;
    /// V d/dx + 1/h at each nearby point: places among the wet points and their factors [1/s]
    std::vector<std::vector<std::pair<unsigned int, double>>> transport;
    double mean[3];
    /// entries of A on its diagonal, 3 n_points; empty of half-spaces alone
    std::vector<double> diagonals;
    /// of the nearby points: basis, and StepMatrices::by_displacement and by_velocity side by side; 3
    /// n_points x rank, twice the rank
    DenseMatrix basis, by_motion;
    /// The same points of the grid.
    std::vector<unsigned int> on_grid(const std::vector<unsigned int> &points) const;
    /// Of a matrix of the grid rows at the nearby points' columns.
    DenseMatrix columns_at_points(const DenseMatrix &matrix, const std::vector<unsigned int> &of_rows) const;
    void take_single_precision() const;
    /// whether vmult_change has columns in single precision
    bool changes_in_single_precision() const;
    /// y = columns R, with few sources by their columns alone
    void multiply_columns(const DenseMatrix &columns, const DenseVector &R,
                          const std::vector<unsigned int> &sources, DenseVector &y) const;
    /// Residual displacements of rows of the grid, of half-spaces alone.
    void respond_by_kernels(const DenseVector &R, const std::vector<unsigned int> &sources,
                            const std::vector<unsigned int> &of_rows, DenseVector &displacement) const;
    /// The rows of y before those behind it, from residual displacements at the points and the wet ones: w of gap and slip.
    void transport_residual(const double *w, double *y) const;
    /// W~ from the points to the rows behind y, and what d/dx of it is beyond differences times V; empty of half-spaces alone
    DenseMatrix residual_columns, gradient_columns;
    /// W~ from the points to the normal rows of the others; empty until it is needed, and of half-spaces alone
    mutable DenseMatrix columns_of_others;
    /// what vmult_change takes in single precision, columns of padded length one behind the other: of W~ and of basis^T for each
    /// force, and of by_motion [G; H], what the shapes' numbers move; empty until it is needed
    mutable AlignedSingleVector single_columns, single_basis, single_motion;
    /// columns of the forces that change, the forces, and rows, shapes' numbers and rows that these move by them
    mutable std::vector<unsigned int> single_listed;
    mutable AlignedSingleVector single_forces, single_rows, single_numbers, single_moved;
    mutable DenseVector residual, along_path, c_normal, c_tangential, displacement, velocity;
    /// displacements above velocities of each motion
    mutable std::vector<DenseVector> moved;
  };
} // namespace vibrocontact
