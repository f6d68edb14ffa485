// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/geometry/rigid_motion.h>
#include <moraine/core/exceptions.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/physics/transformations.h>

#include <cmath>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  Pose<dim>::Pose()
    : matrix(unit_symmetric_tensor<dim>())
  {}

  template <int dim>
  Pose<dim>::Pose(const Point<dim>     &centre,
                  const Tensor<1, dim> &translation,
                  const double          angle,
                  const Tensor<1, dim> &axis)
    : centre(centre)
    , translation(translation)
  {
    if constexpr (dim == 2)
      {
        (void)axis;
        matrix = Physics::Transformations::Rotations::rotation_matrix_2d(angle);
      }
    else
      matrix =
        Physics::Transformations::Rotations::rotation_matrix_3d(axis, angle);
  }

  template <int dim>
  Point<dim>
  Pose<dim>::map(const Point<dim> &X) const
  {
    return centre + translation + matrix * (X - centre);
  }

  template <int dim>
  Point<dim>
  Pose<dim>::inverse(const Point<dim> &x) const
  {
    return centre + transpose(matrix) * (x - centre - translation);
  }

  template <int dim>
  Tensor<1, dim>
  Pose<dim>::rotate(const Tensor<1, dim> &v) const
  {
    return matrix * v;
  }

  template <int dim>
  const Tensor<2, dim> &
  Pose<dim>::rotation() const
  {
    return matrix;
  }

  template <int dim>
  RigidMotion<dim>::RigidMotion(const std::array<Curve, dim> &translation,
                                const Curve                  &angle,
                                const Point<dim>             &centre,
                                const Tensor<1, dim>         &axis)
    : translation(translation)
    , angle(angle)
    , centre(centre)
    , axis(axis)
  {
    if (dim == 3 && angle)
      {
        if (!(axis.norm() > 0.))
          throw InputError("the axis of a rotation must not be zero");
        this->axis /= axis.norm();
      }
  }

  namespace
  {
    double
    evaluate(const std::function<double(const double)> &curve,
             const double                               t,
             const std::string                         &what)
    {
      if (!curve)
        return 0.;
      const double value = curve(t);
      if (!std::isfinite(value))
        throw InputError("the prescribed " + what +
                         " is not a number at t = " + std::to_string(t));
      return value;
    }
  } // namespace

  template <int dim>
  Pose<dim>
  RigidMotion<dim>::pose(const double t) const
  {
    if (!moves())
      return Pose<dim>();
    Tensor<1, dim> shift;
    for (unsigned int d = 0; d < dim; ++d)
      shift[d] =
        evaluate(translation[d], t, std::string("translation in ") + "xyz"[d]);
    const double degrees = evaluate(angle, t, "rotation angle");
    return Pose<dim>(centre, shift, degrees * numbers::PI / 180., axis);
  }

  template <int dim>
  bool
  RigidMotion<dim>::moves() const
  {
    for (const auto &curve : translation)
      if (curve)
        return true;
    return static_cast<bool>(angle);
  }

  template <int dim>
  double
  RigidMotion<dim>::moment(const Point<dim>     &x,
                           const Tensor<1, dim> &f,
                           const double          t) const
  {
    const Tensor<1, dim> arm = x - pose(t).map(centre);
    if constexpr (dim == 2)
      return arm[0] * f[1] - arm[1] * f[0];
    else
      return axis * cross_product_3d(arm, f);
  }

  template <int dim>
  MovedSurface<dim>::MovedSurface(std::shared_ptr<const Surface<dim>> reference,
                                  const Pose<dim>                    &pose)
    : reference(std::move(reference))
    , present(pose)
  {}

  template <int dim>
  void
  MovedSurface<dim>::set_pose(const Pose<dim> &pose)
  {
    present = pose;
  }

  template <int dim>
  const Pose<dim> &
  MovedSurface<dim>::pose() const
  {
    return present;
  }

  template <int dim>
  double
  MovedSurface<dim>::level(const Point<dim> &x) const
  {
    return reference->level(present.inverse(x));
  }

  template <int dim>
  Tensor<1, dim>
  MovedSurface<dim>::normal(const Point<dim> &x) const
  {
    return present.rotate(reference->normal(present.inverse(x)));
  }

  template <int dim>
  bool
  MovedSurface<dim>::in_extent(const Point<dim> &x) const
  {
    return reference->in_extent(present.inverse(x));
  }

  template <int dim>
  void
  MovedSurface<dim>::pieces(const CellVertices<dim>        &cell,
                            const unsigned int              n_gauss,
                            std::vector<SurfacePoint<dim>> &out) const
  {
    CellVertices<dim> mapped;
    for (unsigned int v = 0; v < cell.size(); ++v)
      mapped[v] = present.inverse(cell[v]);
    const std::size_t before = out.size();
    reference->pieces(mapped, n_gauss, out);
    for (std::size_t i = before; i < out.size(); ++i)
      {
        out[i].x      = present.map(out[i].x);
        out[i].normal = present.rotate(out[i].normal);
      }
  }

  template <int dim>
  BoundingBox<dim>
  MovedSurface<dim>::bounding_box() const
  {
    const auto              box = reference->bounding_box();
    std::vector<Point<dim>> corners;
    for (unsigned int v = 0; v < (1 << dim); ++v)
      corners.push_back(present.map(box.vertex(v)));
    return BoundingBox<dim>(corners);
  }

  template <int dim>
  bool
  MovedSurface<dim>::curved() const
  {
    return reference->curved();
  }

  template class Pose<2>;
  template class Pose<3>;
  template class RigidMotion<2>;
  template class RigidMotion<3>;
  template class MovedSurface<2>;
  template class MovedSurface<3>;
} // namespace moraine
