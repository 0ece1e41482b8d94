#pragma once

#include <vibrocontact/contact/laws/law_parameter.h>

#include <functional>

namespace vibrocontact
{
  /// A contact law for the normal force N >= 0 (compression) and the gap g (open: > 0), written once as its graph:
  /// force and penetration d = -g, both not falling along a parameter s, in contact for s > 0,
  ///
  ///   N = N(s),  d = d(s),      N(0) = d(0) = 0;      without contact N = 0.
  ///
  /// A law that is a function of the gap has s = d (SpringLaw), the rigid stop s = N. Everything else follows from the
  /// graph: the projection that solvers work with,
  ///
  ///   N = P(N, g; rho)   for any rho > 0                                        (Lai et al. 2018, Eq. 3)
  ///
  /// is its resolvent, the point with N(s) + rho d(s) = N - rho g, and its tangent that of this equation.
  class NormalLaw
  {
  public:
    /// A point of the graph [N, m] and its derivatives along s. Members continue it smoothly to s < 0, so that the end
    /// of a contact is a simple zero of the force.
    struct GraphPoint
    {
      double force, penetration, force_slope, penetration_slope;
    };

    /// Value of P and its derivatives with respect to the force and to the gap.
    struct Projection
    {
      /// [N]
      double force;
      /// dP/dN [-], dP/dg [N/m]; both zero where the point is open and stays so to first order
      double by_force, by_gap;
    };

    /// Compression that a contact force needs, and its derivative.
    struct Compression
    {
      /// [m], [m/N]
      double depth, compliance;
    };

    virtual ~NormalLaw() = default;
    /// What create_normal_law() needs to make the law again.
    virtual LawDescription description() const = 0;
    virtual GraphPoint graph(double s) const = 0;
    /// Whether the force is a function of the gap: the penetration is the parameter s.
    virtual bool is_function_of_gap() const { return false; }
    /// Whether force and penetration are proportional (or the penetration zero): one compliance for all forces.
    virtual bool is_linear() const { return false; }
    /// Penetrations at which pieces of the graph join that are smooth by themselves, ascending [m]; without zero.
    virtual std::vector<double> breaks() const { return {}; }
    /// energy that the law itself stores at a gap [J]; members replace the integral only where that pays
    virtual double potential(double gap) const { return integrated_force(gap); }
    /// The resolvent; members replace it only where that pays (measured in doc/contact.md).
    virtual Projection project(double force, double gap, double rho) const
    {
      return resolvent(force, gap, rho);
    }

    /// P by Newton's method on the graph, with the tangent by implicit differentiation.
    Projection resolvent(double force, double gap, double rho) const;
    /// The parameter s with a N(s) + b d(s) = value; a [-] and b [N/m] not negative. Newton's method within a bracket.
    /// @throws ConvergenceError if there is none
    double parameter_at(double a, double b, double value) const;
    /// d(N) and its derivative, continued to N < 0.
    Compression compression(double force) const;
    /// Whether the stop does not yield at all.
    bool is_rigid() const { return graph(0).penetration_slope == 0; }
    /// int N dd by Gauss points between the breaks [J]
    double integrated_force(double gap) const;
  };

  /// A law whose force is a function of the gap: a spring behind the surface, open gaps without force.
  class SpringLaw : public NormalLaw
  {
  public:
    GraphPoint graph(double penetration) const override
    {
      const auto [force, stiffness] = spring(penetration);
      return {force, penetration, stiffness, 1.};
    }
    bool is_function_of_gap() const override { return true; }

  protected:
    struct Spring
    {
      /// [N], [N/m]
      double force, stiffness;
    };
    /// f(d) and f'(d), continued to d < 0
    virtual Spring spring(double penetration) const = 0;
  };

  /// One row of the table of normal laws.
  struct NormalLawEntry
  {
    /// in the parameter file, and a sentence
    std::string name, help;
    std::vector<LawParameter> parameters;
    /// from the numbers of the parameters; @throws InputError
    std::function<std::shared_ptr<const NormalLaw>(const std::vector<double> &)> make;
  };
} // namespace vibrocontact
