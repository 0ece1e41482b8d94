#pragma once

#include <vibrocontact/contact/contact_problem.h>
#include <vibrocontact/coupled_bodies/contact_pair.h>

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// State of a pair of bodies at one instant: all that the next step depends on.
  struct DynamicState
  {
    double time = 0;
    /// length of the step that led here; 0: none did [s]
    double last_step = 0;
    /// modal amplitudes [m sqrt(kg)] and velocities; n_modes
    std::vector<double> q, v;
    /// forces on body 1 [N]; residual displacements, W~ R where nothing relaxes [m], without what the given force answers
    /// at rest (ContactPair::force_response()), kept at the nearby points and their neighbours up- and downstream, the gaps' rows
    /// of all others as at the last look at them (Proximity); 3 n
    DenseVector R, residual_displacement;
    /// rate of the residual displacements along the surface at the same points, as the last step had it in its slip [m/s]; 3 n
    DenseVector residual_rate;
    /// of each rest that relaxes (ContactPair::relaxing) the forces s that it has followed so far, 3 n [N]
    std::vector<DenseVector> relaxed;
    /// what both have changed by in the last step and in the one before: the next one starts with the same change, or with one that
    /// changes as it did, whichever would have been nearer to the last
    DenseVector force_change, residual_change, force_change_before, residual_change_before;
    bool extrapolates_change = false;
    /// Psi^T R [N/sqrt(kg)]; n_modes
    DenseVector modal_force;
    /// states of the poles, what the contact feeds into them, left^T R, and right^T R, by which they work; n_poles
    std::vector<std::complex<double>> z, pole_force, pole_reaction;
    /// powers of the tangential forces [W]: dissipated by friction (>= 0), given to the bodies by the
    /// creepage and by the transport -V R . du/dx
    double friction_power = 0, creepage_power = 0, transport_power = 0;
    /// Drive::hub_acceleration and Drive::force at this instant
    double hub_acceleration = 0, force = 0;
    /// how the contact was solved at this instant: status, gap and slip, approach. At points that are not
    /// nearby, the gap has W~ R of the last look at them (Proximity), the slip is zero.
    ContactSolution contact;
    /// roughness at the end of the last step [m]; n, empty: none
    std::vector<double> roughness;
    /// points in the contact problem of a step, ascending; empty: to be found
    std::vector<unsigned int> nearby;
    /// how far W~ R may have moved points that are not nearby since the last look at them [m], and the steps since the last search
    /// of all points
    double moved_since_look = 0;
    unsigned int steps_since_search = 0;
  };

  /// The forces that rest k of a pair relaxes towards: the contact's and, of body 1, the given one; 3 n [N].
  DenseVector forces_on_rest(const ContactPair &pair, unsigned int k, const DynamicState &state);

  /// Fills what follows from q, v, R and the slip (contact.y) of an initial state, at rest in the moving frame
  /// but for v: modal forces, W~ R, powers (with the rigid slip, 3 n [m/s]). Rests have relaxed unless the state says so.
  void complete(const ContactPair &pair, const DenseVector &rigid_slip, DynamicState &state);

  /// Residual displacements of its forces, and of what the rests have followed so far.
  void set_residual_displacement(const ContactPair &pair, DynamicState &state);
  /// The same, and W~ force_change and W~ force_change_before, by one pass over W~.
  void set_residual_displacement_and_changes(const ContactPair &pair, DynamicState &state);
  /// Powers of forces and slips on the same points. @param rate R . du/dt of the tangential displacements [W]
  void set_powers(const DenseVector &R, const DenseVector &slip, const DenseVector &rigid_slip,
                  unsigned int n, double rate, DynamicState &state);
} // namespace vibrocontact
