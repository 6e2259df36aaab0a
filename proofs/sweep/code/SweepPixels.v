(** What the sweep asks at a pixel, recorded, is what EdgeBounds.v and Cells.v speak of.

    The code is `_block` and `_may_be_seen` of rasterise.py, depth_buffer.py and
    `enter_planes` of sweep.py. What each recorded expression comes to, in real numbers with a rounding
    at every operation, is the formula of that name. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Geometry Trees RecordedPixels Rounding EdgeFunctions.
From Reftrace Require Import Cells SweepCode.
Open Scope R_scope.
Open Scope string_scope.

Section Pixels.
Variable v : renv.
Notation var := (r_var v).

(** ** A block: pixel by pixel *)

(** The pixel, counted from where the functions are; it is the first one of a block, so 0 is added. *)
Definition up_ : R := rnd (rnd (var "y" + rnd (var "region_y" - var "origin_y")) + 0).
Definition right_ : R := rnd (rnd (var "x" + rnd (var "region_x" - var "origin_x")) + 0).
Definition of_bc : linear := Linear (var "bc_1") (var "bc_y") (var "bc_x").
Definition of_ca : linear := Linear (var "ca_1") (var "ca_y") (var "ca_x").
Definition of_ab : linear := Linear (var "ab_1") (var "ab_y") (var "ab_x").
Definition of_nearness : linear := Linear (var "nearness_1") (var "nearness_y") (var "nearness_x").
Definition least_edge (up right : R) : R :=
  Rmin (Rmin (at_ of_bc up right) (at_ of_ca up right)) (at_ of_ab up right).

Theorem block_right :
  fl v block_edge = least_edge up_ right_ /\
  (truth rnd v block_inside = true <-> least_edge up_ right_ >= - var "edge_error") /\
  fl v block_least = rnd (at_ of_nearness up_ right_ - var "nearness_error") /\
  fl v block_most = most_at of_nearness (var "nearness_error") (var "nearest") up_ right_ /\
  (truth rnd v block_sure = true <->
    least_edge up_ right_ > var "edge_error" /\ r_given v "sure" = true).
Proof.
  assert (E : fl v block_edge = least_edge up_ right_)
    by (unfold block_edge; cbn [value]; numbers; reflexivity).
  split; [exact E|]. split; [|split; [|split]].
  - change block_inside with (LessEq (Neg (Var "edge_error")) block_edge). cbn [truth].
    rewrite true_less_eq, E. cbn [value]. lra.
  - unfold block_least. cbn [value]. numbers. reflexivity.
  - unfold block_most. cbn [value]. numbers. reflexivity.
  - change block_sure with (And (Less (Var "edge_error") block_edge) (Given "sure")). cbn [truth].
    rewrite andb_true_iff, true_less, E. cbn [value]. tauto.
Qed.

(** ** A cell *)

Definition up0 : R := rnd (var "y" + rnd (var "region_y" - var "origin_y")).
Definition up1 : R := rnd (up0 + rnd (var "y_end" - var "y")).
Definition right0 : R := rnd (var "x" + rnd (var "region_x" - var "origin_x")).
Definition right1 : R := rnd (right0 + rnd (var "x_end" - var "x")).
Definition most_in (f : linear) : R := most_of f up0 up1 right0 right1.

Theorem may_be_seen_right : truth rnd v may_be_seen = true <->
  ~ (Rmin (Rmin (most_in of_bc) (most_in of_ca)) (most_in of_ab) < - var "edge_error") /\
  ~ (rnd (most_in of_nearness + var "nearness_error") < var "farthest").
Proof.
  assert (E : truth rnd v may_be_seen = negb
    (Rlt_bool (Rmin (Rmin (most_in of_bc) (most_in of_ca)) (most_in of_ab)) (- var "edge_error")
     || Rlt_bool (rnd (most_in of_nearness + var "nearness_error")) (var "farthest")))
    by (unfold may_be_seen; cbn [value truth]; numbers; reflexivity).
  rewrite E, negb_orb, andb_true_iff, !negb_true_iff, <- !not_true_iff_false, !true_less. reflexivity.
Qed.

(** ** The clip range, and planes *)

Lemma room_up : 1 + 4 * u = 1 + room4 /\ 1 + 4 * u = 1 - - room4. Proof. unfold room4. lra. Qed.
Lemma room_down : 1 - 4 * u = 1 - room4 /\ 1 - 4 * u = 1 + - room4. Proof. unfold room4. lra. Qed.

Theorem clip_perspective_right : var "start" > 0 ->
  (truth rnd v clip_perspective_inside = true <->
    var "least" > nearness_low (- room4) (var "end") /\
    var "most" < nearness_high (- room4) (var "start")) /\
  (truth rnd v clip_perspective_outside = true <->
    var "most" < nearness_low room4 (var "end") \/ var "least" > nearness_high room4 (var "start")).
Proof.
  intros S. unfold clip_perspective_inside, clip_perspective_outside, nearness_low, nearness_high.
  cbn [value truth]. numbers.
  rewrite andb_true_iff, orb_true_iff, !true_less, (Rmax_left (var "start")) by lra.
  destruct room_up as [<- <-], room_down as [<- <-]. split; split; intros [H|H] || intros [H I]; auto; tauto.
Qed.

(** Where the clip end is finite: where it is not, `inside` does not look at the clip start, and this
    says nothing of that, as in real numbers every end is finite. *)
Theorem clip_parallel_right :
  (truth rnd v clip_parallel_inside = true <-> var "least" > - var "end" /\ var "most" < - var "start") /\
  (truth rnd v clip_parallel_outside = true <-> var "most" < - var "end" \/ var "least" > - var "start").
Proof.
  unfold clip_parallel_inside, clip_parallel_outside. cbn [value truth].
  rewrite andb_true_iff, orb_true_iff, !true_less. tauto.
Qed.

Theorem plane_pixel_perspective_right : var "low" > 0 ->
  fl v plane_pixel_perspective_least = nearness_low room4 (var "high") /\
  fl v plane_pixel_perspective_most = nearness_high room4 (var "low") /\
  truth rnd v plane_pixel_perspective_sure = true.
Proof.
  intros S. unfold plane_pixel_perspective_least, plane_pixel_perspective_most, nearness_low, nearness_high.
  cbn [value truth]. numbers. rewrite (Rmax_left (var "low")) by lra.
  destruct room_up as [<- _], room_down as [<- _]. easy.
Qed.
Theorem plane_pixel_parallel_right :
  fl v plane_pixel_parallel_least = - var "high" /\ fl v plane_pixel_parallel_most = - var "low" /\
  truth rnd v plane_pixel_parallel_sure = true.
Proof. repeat split. Qed.

(** ** The depth buffer *)

(** Where a pixel has a winner w, and e comes, which beats it; and w may still be nearer. *)
Theorem enter_right (w e : entry) rivals : least w = var "winner_least" -> most w = var "winner_most" ->
  least e = var "least" ->
  (truth rnd v enter_nearer = true <-> least w < least e) /\
  (truth rnd v enter_winner_may_be_nearer = true <-> ~ most w < least e) /\
  fl v enter_nearness = least e /\
  (truth rnd v enter_path = true -> enter (Pixel (Some w) rivals) e = Pixel (Some e) (w :: rivals)).
Proof.
  intros L M N. unfold enter. simpl winner. simpl Cells.rivals. rewrite L, M, N.
  unfold enter_nearer, enter_winner_may_be_nearer, enter_nearness, enter_path. cbn [value truth].
  rewrite andb_true_iff, negb_true_iff, <- !not_true_iff_false, !true_less.
  split; [reflexivity|]. split; [reflexivity|]. split; [reflexivity|]. intros [H I].
  rewrite Rlt_bool_true, Rlt_bool_false by lra. reflexivity.
Qed.
End Pixels.
