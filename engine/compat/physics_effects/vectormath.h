// Vector math types of the overview's API: sce::Vectormath::Scalar::Aos.
// Plain scalar arithmetic; vectors take 16 bytes and are aligned to them, as users of the API expect.
#pragma once

#include <cmath>

namespace sce {
namespace Vectormath {
namespace Scalar {

// A float that stands in for a vector register. Converts both ways.
class floatInVec {
 public:
  // The float, and arithmetic that changes it.
  floatInVec() : value_(0.0f) {}
  floatInVec(float value) : value_(value) {}
  float getAsFloat() const { return value_; }
  operator float() const { return value_; }
  floatInVec& operator+=(float b) { return value_ += b, *this; }
  floatInVec& operator-=(float b) { return value_ -= b, *this; }
  floatInVec& operator*=(float b) { return value_ *= b, *this; }
  floatInVec& operator/=(float b) { return value_ /= b, *this; }

 private:
  float value_;
};

// A truth value that stands in for a vector register. Converts both ways.
class boolInVec {
 public:
  // The truth value, and logic that changes it.
  boolInVec() : value_(false) {}
  boolInVec(bool value) : value_(value) {}
  bool getAsBool() const { return value_; }
  operator bool() const { return value_; }
  boolInVec& operator&=(bool b) { return value_ = value_ && b, *this; }
  boolInVec& operator|=(bool b) { return value_ = value_ || b, *this; }
  boolInVec& operator^=(bool b) { return value_ = value_ != b, *this; }

 private:
  bool value_;
};

// b where choose_b is true, else a.
inline floatInVec select(floatInVec a, floatInVec b, boolInVec choose_b) { return choose_b.getAsBool() ? b : a; }
inline boolInVec select(boolInVec a, boolInVec b, boolInVec choose_b) { return choose_b.getAsBool() ? b : a; }

namespace Aos {

class Vector4;
class Point3;
class Quat;
class Matrix3;

// A direction or displacement.
class alignas(16) Vector3 {
 public:
  // Made of its elements x, y, z (zeros without any), which are read and set by name or index; arithmetic is by element.
  Vector3() : e_{0, 0, 0, 0} {}
  Vector3(float x, float y, float z) : e_{x, y, z, 0} {}
  explicit Vector3(float all) : e_{all, all, all, 0} {}
  explicit Vector3(floatInVec all) : Vector3(all.getAsFloat()) {}
  explicit Vector3(const Point3& p);
  static Vector3 xAxis() { return Vector3(1, 0, 0); }
  static Vector3 yAxis() { return Vector3(0, 1, 0); }
  static Vector3 zAxis() { return Vector3(0, 0, 1); }
  float getX() const { return e_[0]; }
  float getY() const { return e_[1]; }
  float getZ() const { return e_[2]; }
  Vector3& setX(float v) { return e_[0] = v, *this; }
  Vector3& setY(float v) { return e_[1] = v, *this; }
  Vector3& setZ(float v) { return e_[2] = v, *this; }
  float getElem(int i) const { return e_[i]; }
  Vector3& setElem(int i, float v) { return e_[i] = v, *this; }
  float& operator[](int i) { return e_[i]; }
  float operator[](int i) const { return e_[i]; }
  Vector3 operator-() const { return Vector3(-e_[0], -e_[1], -e_[2]); }
  Vector3& operator+=(const Vector3& b) { return *this = Vector3(e_[0] + b[0], e_[1] + b[1], e_[2] + b[2]); }
  Vector3& operator-=(const Vector3& b) { return *this = Vector3(e_[0] - b[0], e_[1] - b[1], e_[2] - b[2]); }
  Vector3& operator*=(float s) { return *this = Vector3(e_[0] * s, e_[1] * s, e_[2] * s); }
  Vector3& operator/=(float s) { return *this = Vector3(e_[0] / s, e_[1] / s, e_[2] / s); }

 private:
  float e_[4];
};
// Sums, and products with numbers.
inline Vector3 operator+(Vector3 a, const Vector3& b) { return a += b; }
inline Vector3 operator-(Vector3 a, const Vector3& b) { return a -= b; }
inline Vector3 operator*(Vector3 a, float s) { return a *= s; }
inline Vector3 operator*(float s, Vector3 a) { return a *= s; }
inline Vector3 operator/(Vector3 a, float s) { return a /= s; }

// A place.
class alignas(16) Point3 {
 public:
  // Made of its elements x, y, z (zeros without any), which are read and set by name or index; a vector moves it.
  Point3() : e_{0, 0, 0, 0} {}
  Point3(float x, float y, float z) : e_{x, y, z, 0} {}
  explicit Point3(float all) : e_{all, all, all, 0} {}
  explicit Point3(const Vector3& v) : e_{v[0], v[1], v[2], 0} {}
  float getX() const { return e_[0]; }
  float getY() const { return e_[1]; }
  float getZ() const { return e_[2]; }
  Point3& setX(float v) { return e_[0] = v, *this; }
  Point3& setY(float v) { return e_[1] = v, *this; }
  Point3& setZ(float v) { return e_[2] = v, *this; }
  float getElem(int i) const { return e_[i]; }
  Point3& setElem(int i, float v) { return e_[i] = v, *this; }
  float& operator[](int i) { return e_[i]; }
  float operator[](int i) const { return e_[i]; }
  Point3& operator+=(const Vector3& b) { return *this = Point3(e_[0] + b[0], e_[1] + b[1], e_[2] + b[2]); }
  Point3& operator-=(const Vector3& b) { return *this = Point3(e_[0] - b[0], e_[1] - b[1], e_[2] - b[2]); }

 private:
  float e_[4];
};
// From the origin to the point.
inline Vector3::Vector3(const Point3& p) : e_{p[0], p[1], p[2], 0} {}
// A point moved by a vector, and the vector between points.
inline Point3 operator+(Point3 a, const Vector3& b) { return a += b; }
inline Point3 operator+(const Vector3& a, Point3 b) { return b += a; }
inline Point3 operator-(Point3 a, const Vector3& b) { return a -= b; }
inline Vector3 operator-(const Point3& a, const Point3& b) { return Vector3(a) - Vector3(b); }

// Four numbers.
class alignas(16) Vector4 {
 public:
  // Made of its elements x, y, z, w (zeros without any; w is 1 of a point, 0 of a vector), which are read and set by name or
  // index; arithmetic is by element.
  Vector4() : e_{0, 0, 0, 0} {}
  Vector4(float x, float y, float z, float w) : e_{x, y, z, w} {}
  Vector4(const Vector3& v, float w) : e_{v[0], v[1], v[2], w} {}
  explicit Vector4(const Vector3& v) : Vector4(v, 0.0f) {}
  explicit Vector4(const Point3& p) : e_{p[0], p[1], p[2], 1} {}
  explicit Vector4(const Quat& q);
  explicit Vector4(float all) : e_{all, all, all, all} {}
  static Vector4 xAxis() { return Vector4(1, 0, 0, 0); }
  static Vector4 yAxis() { return Vector4(0, 1, 0, 0); }
  static Vector4 zAxis() { return Vector4(0, 0, 1, 0); }
  static Vector4 wAxis() { return Vector4(0, 0, 0, 1); }
  float getX() const { return e_[0]; }
  float getY() const { return e_[1]; }
  float getZ() const { return e_[2]; }
  float getW() const { return e_[3]; }
  Vector4& setX(float v) { return e_[0] = v, *this; }
  Vector4& setY(float v) { return e_[1] = v, *this; }
  Vector4& setZ(float v) { return e_[2] = v, *this; }
  Vector4& setW(float v) { return e_[3] = v, *this; }
  Vector3 getXYZ() const { return Vector3(e_[0], e_[1], e_[2]); }
  Vector4& setXYZ(const Vector3& v) { return *this = Vector4(v, e_[3]); }
  float getElem(int i) const { return e_[i]; }
  Vector4& setElem(int i, float v) { return e_[i] = v, *this; }
  float& operator[](int i) { return e_[i]; }
  float operator[](int i) const { return e_[i]; }
  Vector4 operator-() const { return Vector4(-e_[0], -e_[1], -e_[2], -e_[3]); }
  Vector4& operator+=(const Vector4& b) { return *this = Vector4(e_[0] + b[0], e_[1] + b[1], e_[2] + b[2], e_[3] + b[3]); }
  Vector4& operator-=(const Vector4& b) { return *this += -b; }
  Vector4& operator*=(float s) { return *this = Vector4(e_[0] * s, e_[1] * s, e_[2] * s, e_[3] * s); }
  Vector4& operator/=(float s) { return *this = Vector4(e_[0] / s, e_[1] / s, e_[2] / s, e_[3] / s); }

 private:
  float e_[4];
};
// Sums, products with numbers and by element, and the inner product.
inline Vector4 operator+(Vector4 a, const Vector4& b) { return a += b; }
inline Vector4 operator-(Vector4 a, const Vector4& b) { return a -= b; }
inline Vector4 operator*(Vector4 a, float s) { return a *= s; }
inline Vector4 operator*(float s, Vector4 a) { return a *= s; }
inline Vector4 operator/(Vector4 a, float s) { return a /= s; }
inline Vector4 mulPerElem(const Vector4& a, const Vector4& b) { return Vector4(a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]); }
inline float dot(const Vector4& a, const Vector4& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

// x, y, z, w; a unit quaternion rotates.
class alignas(16) Quat {
 public:
  // Made of its elements (no rotation without any), of a rotation matrix, or of an angle in rad about a unit axis; the product
  // turns by the right one first.
  Quat() : e_{0, 0, 0, 1} {}
  Quat(float x, float y, float z, float w) : e_{x, y, z, w} {}
  Quat(const Vector3& v, float w) : e_{v[0], v[1], v[2], w} {}
  explicit Quat(const Vector4& v) : e_{v[0], v[1], v[2], v[3]} {}
  explicit Quat(const Matrix3& m);
  explicit Quat(float all) : e_{all, all, all, all} {}
  static Quat identity() { return Quat(); }
  static Quat rotation(float radians, const Vector3& unit_axis);
  static Quat rotation(const Vector3& unit_from, const Vector3& unit_to);
  static Quat rotationX(float radians) { return rotation(radians, Vector3::xAxis()); }
  static Quat rotationY(float radians) { return rotation(radians, Vector3::yAxis()); }
  static Quat rotationZ(float radians) { return rotation(radians, Vector3::zAxis()); }
  float getX() const { return e_[0]; }
  float getY() const { return e_[1]; }
  float getZ() const { return e_[2]; }
  float getW() const { return e_[3]; }
  Quat& setX(float v) { return e_[0] = v, *this; }
  Quat& setY(float v) { return e_[1] = v, *this; }
  Quat& setZ(float v) { return e_[2] = v, *this; }
  Quat& setW(float v) { return e_[3] = v, *this; }
  Vector3 getXYZ() const { return Vector3(e_[0], e_[1], e_[2]); }
  Quat& setXYZ(const Vector3& v) { return *this = Quat(v, e_[3]); }
  float getElem(int i) const { return e_[i]; }
  Quat& setElem(int i, float v) { return e_[i] = v, *this; }
  float& operator[](int i) { return e_[i]; }
  float operator[](int i) const { return e_[i]; }
  Quat operator-() const { return Quat(-e_[0], -e_[1], -e_[2], -e_[3]); }
  Quat& operator+=(const Quat& b) { return *this = Quat(e_[0] + b[0], e_[1] + b[1], e_[2] + b[2], e_[3] + b[3]); }
  Quat& operator-=(const Quat& b) { return *this += -b; }
  Quat& operator*=(const Quat& b);
  Quat& operator*=(float s) { return *this = Quat(e_[0] * s, e_[1] * s, e_[2] * s, e_[3] * s); }

 private:
  float e_[4];
};

// The elements.
inline Vector4::Vector4(const Quat& q) : e_{q[0], q[1], q[2], q[3]} {}

// Length and its square, the vector at length 1, the mean of two weighted 1 - t and t, and the choice of one.
inline float lengthSqr(const Vector4& v) { return dot(v, v); }
inline float length(const Vector4& v) { return std::sqrt(dot(v, v)); }
inline Vector4 normalize(const Vector4& v) { return v / length(v); }
inline Vector4 lerp(float t, const Vector4& a, const Vector4& b) { return a + t * (b - a); }
inline Vector4 select(const Vector4& a, const Vector4& b, bool choose_b) { return choose_b ? b : a; }

// Products and lengths of vectors, distances of points, and arithmetic by element; the vector or point between two by the share
// t; b where choose_b is true, else a. `unit` is of length 1.
inline float dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return Vector3(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}
inline float lengthSqr(const Vector3& v) { return dot(v, v); }
inline float length(const Vector3& v) { return std::sqrt(dot(v, v)); }
inline Vector3 normalize(const Vector3& v) { return v / length(v); }
inline float dist(const Point3& a, const Point3& b) { return length(a - b); }
inline float distSqr(const Point3& a, const Point3& b) { return lengthSqr(a - b); }
inline Vector3 mulPerElem(const Vector3& a, const Vector3& b) { return Vector3(a[0] * b[0], a[1] * b[1], a[2] * b[2]); }
inline Vector3 divPerElem(const Vector3& a, const Vector3& b) { return Vector3(a[0] / b[0], a[1] / b[1], a[2] / b[2]); }
inline Vector3 recipPerElem(const Vector3& a) { return Vector3(1 / a[0], 1 / a[1], 1 / a[2]); }
inline Vector3 absPerElem(const Vector3& a) { return Vector3(std::abs(a[0]), std::abs(a[1]), std::abs(a[2])); }
inline Vector3 minPerElem(const Vector3& a, const Vector3& b) {
  return Vector3(a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1], a[2] < b[2] ? a[2] : b[2]);
}
inline Vector3 maxPerElem(const Vector3& a, const Vector3& b) {
  return Vector3(a[0] > b[0] ? a[0] : b[0], a[1] > b[1] ? a[1] : b[1], a[2] > b[2] ? a[2] : b[2]);
}
inline float maxElem(const Vector3& a) { return a[0] > a[1] ? (a[0] > a[2] ? a[0] : a[2]) : (a[1] > a[2] ? a[1] : a[2]); }
inline float minElem(const Vector3& a) { return -maxElem(-a); }
inline float sum(const Vector3& a) { return a[0] + a[1] + a[2]; }
inline Vector3 lerp(float t, const Vector3& a, const Vector3& b) { return a + t * (b - a); }
inline Point3 lerp(float t, const Point3& a, const Point3& b) { return a + t * (b - a); }
inline Vector3 sqrtPerElem(const Vector3& a) { return Vector3(std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2])); }
inline Vector3 rsqrtPerElem(const Vector3& a) { return recipPerElem(sqrtPerElem(a)); }
inline Vector3 copySignPerElem(const Vector3& size, const Vector3& sign) {
  return Vector3(std::copysign(size[0], sign[0]), std::copysign(size[1], sign[1]), std::copysign(size[2], sign[2]));
}
inline float distFromOrigin(const Point3& p) { return length(Vector3(p)); }
inline float distSqrFromOrigin(const Point3& p) { return lengthSqr(Vector3(p)); }
inline float projection(const Point3& p, const Vector3& unit) { return dot(Vector3(p), unit); }
inline Point3 scale(const Point3& p, float s) { return Point3(s * Vector3(p)); }
inline Point3 scale(const Point3& p, const Vector3& s) { return Point3(mulPerElem(Vector3(p), s)); }
inline Point3 mulPerElem(const Point3& a, const Point3& b) { return Point3(mulPerElem(Vector3(a), Vector3(b))); }
inline Point3 absPerElem(const Point3& a) { return Point3(absPerElem(Vector3(a))); }
inline Point3 maxPerElem(const Point3& a, const Point3& b) { return Point3(maxPerElem(Vector3(a), Vector3(b))); }
inline Point3 minPerElem(const Point3& a, const Point3& b) { return Point3(minPerElem(Vector3(a), Vector3(b))); }
inline Point3 select(const Point3& a, const Point3& b, bool choose_b) { return choose_b ? b : a; }
inline Vector3 select(const Vector3& a, const Vector3& b, bool choose_b) { return choose_b ? b : a; }

// Sums, products, lengths (norm: squared) and the conjugate; rotate() turns a vector by a unit quaternion; lerp() is not of
// length 1.
inline Quat operator+(Quat a, const Quat& b) { return a += b; }
inline Quat operator-(Quat a, const Quat& b) { return a -= b; }
inline Quat operator/(const Quat& a, float s) { return Quat(a[0] / s, a[1] / s, a[2] / s, a[3] / s); }
inline Quat operator*(Quat a, float s) { return a *= s; }
inline Quat operator*(float s, Quat a) { return a *= s; }
inline Quat operator*(const Quat& a, const Quat& b) {
  const Vector3 u = a.getXYZ(), v = b.getXYZ();
  return Quat(a[3] * v + b[3] * u + cross(u, v), a[3] * b[3] - dot(u, v));
}
inline float dot(const Quat& a, const Quat& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }
inline float norm(const Quat& q) { return dot(q, q); }
inline float length(const Quat& q) { return std::sqrt(dot(q, q)); }
inline Quat normalize(const Quat& q) { return q * (1.0f / length(q)); }
inline Quat conj(const Quat& q) { return Quat(-q[0], -q[1], -q[2], q[3]); }
inline Vector3 rotate(const Quat& q, const Vector3& v) {
  const Vector3 u = q.getXYZ(), t = 2.0f * cross(u, v);
  return v + q[3] * t + cross(u, t);
}
inline Quat lerp(float t, const Quat& a, const Quat& b) { return a + t * (b - a); }
// Between two unit quaternions at constant speed, the shorter way round.
Quat slerp(float t, const Quat& unit_a, const Quat& unit_b);
// b where choose_b is true, else a.
inline Quat select(const Quat& a, const Quat& b, bool choose_b) { return choose_b ? b : a; }

inline Quat& Quat::operator*=(const Quat& b) { return *this = *this * b; }

}  // namespace Aos
}  // namespace Scalar
}  // namespace Vectormath
}  // namespace sce

#include "vectormath_matrix.h"
