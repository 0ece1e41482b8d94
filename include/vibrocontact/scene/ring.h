#pragma once

#include <vibrocontact/scene/body_description.h>
#include <vibrocontact/scene/contact_grid.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// A tyre as a ring on an elastic foundation (Meftah & Duhamel 2011, section 5.2, corrected): tread band of
  /// radius R, thickness h and width b, side walls as springs spread around it, inflation pressure p.
  ///
  ///            .-------.             place R theta along the mean circle, theta = 0 at the bottom
  ///          /  springs  \           theta and x = R sin theta point forward (a rolling contact's x points
  ///         |  --- o ---  |          back), z up; a ring that rolls forward turns with Omega = -V / R
  ///          \           / theta ->
  ///            '---o---'             w outward, v along theta
  ///
  /// Energy per unit length of the mean circle, ' = d/dtheta:
  ///
  ///   2 E = B (w'' - v')^2 + k (v' + w)^2 + k_z w^2 + k_theta v^2 + t [(w' - v)^2 + (v' + w)^2]
  ///         - t [w^2 + v^2 + w v' - v w'],      B = E I / R^4,  k = E b h / R^2,  t = p b / R
  ///
  /// The hoop force p b R strains the ring to second order (first bracket); the pressure works on the area
  /// inside (second bracket), unless its direction is fixed, as in the paper's Eq. 60. Turning adds t -> t + m
  /// Omega^2 to both and Coriolis's forces; m = rho b h. Every motion at rest has the same damping ratio.
  struct RingParameters : ElementBody, PointBody
  {
    /// "analytic", "beam elements" or "solid elements"
    std::string model = "analytic";
    /// of the mean circle; of the tread band [m]
    double radius = 0.285, thickness = 0.01, width = 0.16;
    /// [Pa], [kg/m^3]; Poisson's ratio is 0
    double young_modulus = 1e8, density = 2280;
    /// k_z, k_theta [N/m^2]
    double radial_stiffness = 1.64e6, circumferential_stiffness = 2.19e5;
    /// p [Pa]
    double pressure = 2e5;
    /// "follower" or "fixed direction" (as printed)
    std::string pressure_law = "follower";
    bool pressure_follows() const { return pressure_law == "follower"; }
    /// of every motion at rest [-]
    double damping_ratio = 0.05;
    /// whether it turns with the speed of the road
    bool rolling = false;
    /// analytic: poles of the circumferential orders |n| up to this one; statics of those above it
    unsigned int highest_order = 60;
    bool residual = true;
    unsigned int residual_order = 20000;
    /// elements around the ring; degree of the solid ones
    unsigned int divisions = 104, degree = 3;
    /// points that can touch the road, evenly spaced about the bottom; distance along the mean circle [m]
    unsigned int n_points = 3;
    double spacing = 0.00895353906273091;
    /// of the tread under each point, 0: rigid [N/m]
    double tread_stiffness = 0;
    /// of the same along the circle, with friction only [N/m]
    double tread_tangential_stiffness = 0;

    void declare_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &section) const override;
    bool add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const override;
    void print(Log &log) const override;
    nlohmann::ordered_json sizes() const override;
    std::optional<ContactGrid> contact_points(double cell) const override;
    std::unique_ptr<SecondOrderSystem> assemble(const BodyParameters &body, bool above,
                                                const ContactGrid *grid,
                                                MPI_Comm communicator) const override;
    void read_ahead(const ParameterFile &file, const std::string &section) override;
    const ElementBody *elements() const override { return is_meshed() ? this : nullptr; }
    const PointBody *at_points() const override { return is_meshed() ? nullptr : this; }
    BodyInContact between_points(bool with_friction, double speed,
                                 const std::vector<double> &upstream = {}) const override;
    std::vector<std::string> row_names(bool with_friction) const override;
    std::function<dealii::LAPACKFullMatrix<std::complex<double>>(double)>
    sum_of_orders(unsigned int highest, bool residual, bool with_friction, double speed) const override;
    std::optional<Orders> orders() const override { return Orders{highest_order, residual}; }
    BodyInContact on_road(const ReducedBody &reduced, bool with_friction, double speed,
                          const std::vector<double> &upstream) const override;
    bool has_material() const override { return false; }
    bool has_own_points() const override { return true; }
    bool rolls() const override { return rolling; }
    bool has_rigid_points() const override { return !is_meshed() && !residual && tread_stiffness == 0; }
    bool may_yield() const override { return tread_stiffness > 0 || residual; }
    bool has_loss() const override { return damping_ratio > 0; }
    std::vector<double> places() const override;
    std::vector<double> heights() const override;
    double tread_compliance(bool tangential) const override;
    bool touches_downwards_only() const override { return true; }

    bool is_meshed() const { return model != "analytic"; }
    bool is_solid() const { return model == "solid elements"; }
    /// Omega at a speed of rolling [rad/s]: what rolls forward turns backwards in its own coordinate.
    double rotation(const double speed) const { return rolling ? -speed / radius : 0.; }
    /// m [kg/m], B, k and t [N/m^2]
    double line_density() const { return density * thickness * width; }
    double bending() const;
    double membrane() const;
    double tension() const { return pressure * width / radius; }
    /// theta of the contact points, ascending; n_points [rad]
    std::vector<double> angles() const;
    /// theta of places beyond the contact points, from which material comes: n_beyond in front of the first one, nearest
    /// first, then as many behind the last [rad]
    static constexpr unsigned int n_beyond = 2;
    /// So many contact points are single treads (Meftah & Duhamel 2011, section 5.2), beside which nothing touches; more stand
    /// for a tread that goes on around the ring.
    static constexpr unsigned int most_single_treads = 3;
    std::vector<double> angles_beyond() const;
    /// contact points as x = R theta
    ContactGrid grid() const;

    /// L_n for (v, w) e^{j n theta}: [[tangential, -j coupling], [j coupling, radial]] [N/m^2]
    struct Order
    {
      double tangential, radial, coupling;
      double determinant() const { return tangential * radial - coupling * coupling; }
    };
    /// @param rotation Omega [rad/s]
    Order order(unsigned int n, double rotation = 0) const;
    /// Natural frequencies of order n at rest, without damping, the lower first [rad/s]; 0 for a rigid motion.
    std::pair<double, double> frequencies(unsigned int n) const;
    /// External pressure at which the ring at rest buckles in order n [Pa]; 3 EI / (b R^3) for a free thin ring
    /// and n = 2, 4 EI / (b R^3) with a pressure of fixed direction. Infinite if no pressure does.
    double buckling_pressure(unsigned int n) const;
  };
} // namespace vibrocontact
