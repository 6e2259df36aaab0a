(** The theorems of the claim, in the words of docs/proof.md: tools/prove.py asks what they assume. *)
From Reftrace Require Import Rounding Signs Forms Pairs Nearer Hits Fans Closed Integers Clip.
From Reftrace Require Import Whole Nearby Batches Sweep CertifiedDepth CameraRays QuotientBinary.
From Reftrace Require Import Perspective Orthographic Fit FitParallel Cells SweepProven FilmLinked.
From Reftrace Require Beginning RecordedBoxes. (* so that coqchk reads these, too *)
From Reftrace Require Import CodeRange IntegersCode ConversionsCode TwoTriangles.
From Reftrace Require Import LeafYes LeafGiven LeafCode Dropped Room Dropping Box Kept.

(** Rounding: an expression of +, - and * of floats is off by at most (1 + u)^k room - P, gradual
    underflow included; k counts the roundings along its longest path. *)
Check Rounding.error.
(** The bound: an e, T or D with at most 8 roundings is off by at most three quarters of
    E = 12 u P + 2^-1060 (1 + |w|_1), as E is computed. *)
Check Signs.bound_holds.
(** Signs: where the comparison E < e turns out true in binary64, the exact e is positive. *)
Check Signs.sure_positive.
(** Signs: where e < -E turns out true in binary64, the exact e is negative. *)
Check Signs.sure_negative.
(** The forms: the three edge functions of rays from one point have the bound that bounds.py
    computes, whatever overflows. *)
Check Forms.from_point_e.
(** The forms: likewise T of rays from one point. *)
Check Forms.from_point_T.
(** The forms: likewise D of rays from one point. *)
Check Forms.from_point_D.
(** The forms: likewise the three edge functions of parallel rays. *)
Check Forms.parallel_e.
(** The forms: likewise T of parallel rays. *)
Check Forms.parallel_T.
(** The forms: likewise D of parallel rays. *)
Check Forms.parallel_D.
(** The forms: likewise T of an infinite plane. *)
Check Forms.plane_T.
(** The forms: likewise D of an infinite plane. *)
Check Forms.plane_D.
(** Sides: what ladder.py calls sure is inside all three edges. *)
Check Pairs.sides_sure_right.
(** Sides: what it does not call possible is outside of one edge and inside of another. *)
Check Pairs.sides_impossible_right.
(** The interval of t, as computed in binary64, contains the exact T / D, if that is not negative or the
    upper end is a number; a number there says that D is not 0. *)
Check Pairs.interval_right.
(** Order: where order.py knows which of two surfaces is nearer, the sign that decides is right. *)
Check Nearer.order_sign.
(** Ties: what the code says of edges is what one real ray does, along d + (x, x^2, x^3) and from
    o + (y, y^2, y^3), for all small x, and then small y; the same ray for all triangles. *)
Check Hits.crossed_rule_all.
(** Ties: two hits are ordered as that ray meets them. *)
Check Hits.order_rule.
(** Ties: where that order is open, the two surfaces lie in one plane. *)
Check Hits.order_0.
(** Ties: of two triangles that share an edge and lie on different sides of it, exactly one is met by
    a ray that is inside the other edges of both; if they lie on one side, both or none. *)
Check Fans.shared_edge.
(** Ties: of a fan that goes once round a corner, a ray through the corner meets exactly one. *)
Check Fans.fan_rule.
(** Ties: a closed surface is met an even number of times along the whole line, before any hit is left
    out for D = 0 or the clip range. *)
Check Closed.closed_surface_rule.
(** Integers: every float of a batch is its integer times one power of two. *)
Check Integers.integers_exact.
(** Integers: a hit within the clip range is one by its exact t. *)
Check Clip.seen_exact.
(** Integers: t is the exact T / D, rounded once. *)
Check Clip.t_rounded.
(** t: where quotient.py is sure of a finite t, it is the exact quotient rounded once, in binary64,
    whatever overflows; of rays from one origin. *)
Check QuotientBinary.binary_from_point.
(** t: likewise of parallel rays. *)
Check QuotientBinary.binary_parallel.
(** t: likewise of rays that share nothing. *)
Check QuotientBinary.binary_alone.
(** The whole, of plain: the owner is the nearest of the moved ray, by name in one plane; if certain by a bound or by integers, it is
    the one nearest of the stored ray, and else there is none; t is its exact T / D, rounded once. *)
Check CertifiedDepth.certified_with_depth.
(** The whole, of plain: its premises can be met. *)
Check CertifiedDepth.given_but_depth_is_possible.
(** Rays of a perspective camera are among those that its bounds are computed for. *)
Check CameraRays.perspective_reach.
(** Likewise of an orthographic camera. *)
Check CameraRays.parallel_box.
(** The whole, from facts about single surfaces: the owner is the nearest of the moved ray; if
    certain by a bound or by integers, it is the one nearest of the stored ray; t is rounded once. *)
Check Nearby.plain_is_right_by_the_rule.
(** The whole: in whatever order pairs come, the result is the same. *)
Check Batches.order_does_not_matter.
(** The film: of a stored perspective ray and the stored vertices, p, q and w are off by no more than
    film.py says, rays' errors included. *)
Check Perspective.vertex_near.
(** The film: of a triangle that is surely before the eye, the box holds every pixel whose stored ray
    meets it, perspective. *)
Check Perspective.box_holds.
(** The film: nothing that is seen is nearer than the nearest of the corners, perspective. *)
Check Perspective.nearest_seen.
(** The film, orthographic: likewise p, q and the depth. *)
Check Orthographic.vertex_near'.
(** The film, orthographic: likewise the box. *)
Check Orthographic.box_holds'.
(** The film, orthographic: likewise the nearest. *)
Check Orthographic.nearest_seen'.
(** The film, as recorded: a perspective ray, its error, the bounds and what is surely ahead are those of
    these theorems, if each record begins with what another one has ended with. *)
Check FilmLinked.perspective_recorded.
(** Likewise the box of a vertex; perspective. *)
Check FilmLinked.perspective_recorded_vertex.
(** Likewise what the edge functions begin with; perspective. *)
Check FilmLinked.perspective_recorded_stored.
(** Likewise the ray, its error and the bounds; orthographic. *)
Check FilmLinked.parallel_recorded.
(** Likewise the box of a vertex; orthographic. *)
Check FilmLinked.parallel_recorded_vertex.
(** Likewise what the edge functions begin with; orthographic. *)
Check FilmLinked.parallel_recorded_stored.
(** The sweep: what set_up and a pixel's edge functions call sure is met by the stored ray, inside and
    before the eye; perspective. *)
Check Fit.surely_inside.
(** The sweep: what they drop is not met before the eye; perspective. *)
Check Fit.dropped.
(** The sweep: where the sign of T is not known, what both signs drop is not met; perspective. *)
Check Fit.dropped_by_both.
(** The sweep: what is called sure is met; orthographic. *)
Check FitParallel.surely_inside'.
(** The sweep: what is dropped is not met; orthographic. *)
Check FitParallel.dropped'.
(** The sweep: likewise where the sign of T is not known; orthographic. *)
Check FitParallel.dropped_by_both'.
(** The film: axes whose determinant is no less than an eighth of the product of their lengths are far
    enough from a plane for the dual axes' bound. *)
Check FitParallel.well_apart_holds.
(** The sweep, as recorded: the nearness encloses the exact 1 / t; perspective. *)
Check SweepProven.recorded_perspective_nearness.
(** The sweep, as recorded: likewise -t; orthographic. *)
Check SweepProven.recorded_parallel_nearness.
(** The sweep, as recorded: the clip range, perspective. *)
Check SweepProven.recorded_clip_perspective.
(** The sweep, as recorded: the clip range, orthographic. *)
Check SweepProven.recorded_clip_parallel.
(** Cells: no pixel of a cell that an edge rules out would have been covered. *)
Check Cells.ruled_out.
(** Cells: no pixel of a cell that is hidden would have been seen. *)
Check Cells.hidden.
(** The depth buffer: whatever may win, and is not kept, is behind a hit that is sure. *)
Check Cells.all_kept.
(** Nearness from t encloses what is exact. *)
Check Cells.nearness_encloses.
(** The sweep, from facts about single events: it has the owner that plain has, and is ambiguous where
    plain is. *)
Check Sweep.sweep_sees_what_plain_does.
(** Taken of quotient.py is a t that is sure, and finite: as recorded. *)
Check CodeRange.taken_is_finite.
(** Integers: the code's hit of a ray on a triangle, before the clip range, is the model's. *)
Check IntegersCode.hit_is.
(** Integers: likewise on an infinite plane. *)
Check IntegersCode.plane_is.
(** Integers: likewise whether a hit is in the clip range, with a start and an end. *)
Check IntegersCode.clipped_both_is.
(** Integers: likewise what is divided for t. *)
Check IntegersCode.t_is.
(** Integers: likewise the order of two hits of the ray that is not moved. *)
Check IntegersCode.gap_is.
(** Integers: likewise of the moved ray. *)
Check IntegersCode.sign_of_difference_is.
(** Integers: likewise the sign of an edge function for the moved ray. *)
Check IntegersCode.sign_is.
(** Integers: likewise whether the moved ray crosses a triangle. *)
Check IntegersCode.is_crossed_is.
(** Integers: likewise what decides the order of two surfaces for rays from one point. *)
Check IntegersCode.difference_from_point_is.
(** Integers: likewise for parallel rays. *)
Check IntegersCode.difference_parallel_is.
(** Integers: likewise which of three hits is seen. *)
Check IntegersCode.first_of_3_is.
(** Integers: likewise whether two hits leave a tie. *)
Check IntegersCode.no_ties_2_is.
(** Integers: the code makes those integers of floats, with that power of two, that the model does. *)
Check ConversionsCode.integers_is.
(** Integers: by the code's clip limits the same hits are seen as by the model's. *)
Check ConversionsCode.seen_by_ratios_is.
(** Integers: an integer times a power of two becomes a float as in the model: rounded once. *)
Check ConversionsCode.scaled_is.
(** An example: of two triangles, Coq computes that the near one's interval ends before the far one's
    begins. *)
Check TwoTriangles.near_is_nearer.
(** The checker of certificates: where each surface that is not kept at a pixel was dropped by the recorded
    code, from some square whose box has the ray's r between its ends, and what is found among those that
    are kept is what the file says, the file's name is that of one surface, or nothing; this is the nearest
    of the moved ray, by name in one plane; where the file has no ties, it is the one nearest of the stored
    ray, and else there is none; t is its exact T / D, rounded once. *)
Check Kept.checked_is_right.
(** The checker of certificates: of every scene of finite floats, the premises about numbers can be met. *)
Check LeafGiven.given_is_possible.
(** Likewise those about the variables of the recorded code, of every square and surface. *)
Check LeafGiven.can_be_described.
(** The checker of certificates: likewise, if instead what is kept has all that the stored ray meets up to
    the farthest t that matters. *)
Check LeafYes.yes_is_right.
(** The checker of certificates: a ray whose r is in the box of a square does not meet, from clip start to
    far, a triangle that the recorded code drops from it. Of rays from a point. *)
Check Dropping.triangle_point_ruled_out.
(** Likewise of parallel rays. *)
Check Dropping.triangle_parallel_ruled_out.
(** Likewise an infinite plane, of rays from a point. *)
Check Dropping.plane_point_ruled_out.
(** Likewise of parallel rays. *)
Check Dropping.plane_parallel_ruled_out.
(** The checker of certificates: `error` has room for all roundings of a form, over a whole box. *)
Check Room.form_near.
(** The checker of certificates: the recorded box has all that is between its ends, component by
    component. *)
Check Box.code_covers.
(** The checker of certificates: if exact signs rule out, from clip start to some t, each surface that is
    not kept, then all that is met up to that t is kept. *)
Check Dropped.dropped_is_not_met.
(** The checker of certificates, as recorded: its integers are those of the model. *)
Check ConversionsCode.check_integers_is.
(** Likewise its power of two, which is that of all numbers and 1/2. *)
Check ConversionsCode.check_unit_is.
(** The checker of certificates, as recorded: a triangle's T, n and edges are the model's. *)
Check LeafCode.triangle_is.
(** Likewise a plane's. *)
Check LeafCode.plane_is.
(** Likewise the hit of a ray on a triangle, within the clip range. *)
Check LeafCode.hit_is.
(** Likewise on an infinite plane. *)
Check LeafCode.plane_hit_is.
(** Likewise what has the sign for the moved ray. *)
Check LeafCode.moved_is.
(** Likewise whether the moved ray crosses a triangle. *)
Check LeafCode.is_crossed_is.
(** Likewise which of two hits is before the other. *)
Check LeafCode.is_before_is.
(** Likewise which of three hits is crossed first. *)
Check LeafCode.first_of_3_is.
(** Likewise what is seen of three hits, and whether there are ties. *)
Check LeafCode.sees_3_is.
(** An example: of two triangles, Coq computes that the checker sees the near one, at the float t. *)
Check TwoTriangles.checker_agrees.
