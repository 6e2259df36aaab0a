(** What the sweep asks at a pixel, recorded, is what EdgeBounds.v, SmallBoxes.v and Cells.v speak of.

    The code is `_block` and `_may_be_seen` of rasterise.py, small_boxes.py, depth_buffer.py and
    `enter_planes` of sweep.py. What each recorded expression comes to, in real numbers with a rounding
    at every operation, is the formula of that name. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Geometry Trees RecordedPixels Rounding EdgeFunctions SmallBoxes SmallNearness.
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

(** ** A small box *)

Lemma num_E : IZR 2345391125639987 * bpow radix2 (-69) = E. Proof. reflexivity. Qed.
Lemma num_minus_E : IZR (-2345391125639987) * bpow radix2 (-69) = - E.
Proof.
  unfold E. change (IZR (-2345391125639987)) with (- IZR 2345391125639987). ring.
Qed.
Lemma num_ET : IZR 7249389938113249 * bpow radix2 (-69) = 2 * ET.
Proof.
  unfold ET. change (-69)%Z with (1 + -70)%Z. rewrite bpow_plus. change (bpow radix2 1) with 2. ring.
Qed.

Definition x_m : R := rnd (var "x0" + / 2).
Definition y_m : R := rnd (var "y0" + / 2).
Definition small_a : vec := V (rnd (var "xa" - x_m)) (rnd (var "ya" - y_m)) 1.
Definition small_b : vec := V (rnd (var "xb" - x_m)) (rnd (var "yb" - y_m)) 1.
Definition small_c : vec := V (rnd (var "xc" - x_m)) (rnd (var "yc" - y_m)) 1.
Definition small_s : R := sign_of (SmallBoxes.volume small_a small_b small_c).
Definition small_amount : R := Rabs (SmallBoxes.volume small_a small_b small_c).
Definition small_edges (up right : R) : R :=
  Rmin (Rmin (SmallBoxes.small_edge small_s small_b small_c up right)
    (SmallBoxes.small_edge small_s small_c small_a up right))
    (SmallBoxes.small_edge small_s small_a small_b up right).
Definition small_near (up right : R) : R :=
  nearness small_amount (var "na") (var "nb") (var "nc")
    (SmallBoxes.small_edge small_s small_c small_a up right)
    (SmallBoxes.small_edge small_s small_a small_b up right).
Definition small_off : R := nearness_error small_amount (var "na") (var "nb") (var "nc") (var "own").

(** 1, with the sign of T. *)
Lemma copied_sign x : (if Rlt_bool x 0 then - Rabs (IZR 1 * bpow radix2 0) else Rabs (IZR 1 * bpow radix2 0))
  = sign_of x.
Proof. rewrite num_1, Rabs_R1. reflexivity. Qed.

Ltac small x := unfold x; cbn [value truth]; rewrite ?copied_sign; numbers; rewrite ?num_E, ?num_minus_E,
  ?num_ET; cbv [small_edges small_near small_off nearness nearness_error scale SmallBoxes.small_edge
    small_amount small_s SmallBoxes.volume SmallBoxes.of_1 small_a small_b small_c vx vy vz x_m y_m];
  reflexivity.

Theorem small_right :
  fl v small_T = SmallBoxes.volume small_a small_b small_c /\
  fl v RecordedPixels.small_edge = small_edges (var "up") (var "right") /\
  (truth rnd v RecordedPixels.small_inside = true <-> small_edges (var "up") (var "right") >= - E) /\
  fl v small_least = rnd (small_near (var "up") (var "right") - small_off) /\
  fl v small_most = rnd (small_near (var "up") (var "right") + small_off) /\
  (truth rnd v small_sure = true <-> small_edges (var "up") (var "right") > E).
Proof.
  assert (A : fl v RecordedPixels.small_edge = small_edges (var "up") (var "right")) by small RecordedPixels.small_edge.
  split; [small small_T|]. split; [exact A|]. split; [|split; [small small_least|split; [small small_most|]]].
  - change RecordedPixels.small_inside with (LessEq (Num (-2345391125639987) (-69)) RecordedPixels.small_edge).
    cbn [truth]. rewrite true_less_eq, A. cbn [value]. rewrite num_minus_E. lra.
  - change small_sure with (Less (Num 2345391125639987 (-69)) RecordedPixels.small_edge). cbn [truth].
    rewrite true_less, A. cbn [value]. rewrite num_E. lra.
Qed.

(** The record's way through the code: what is nearly edge-on is left to others. *)
Theorem small_path_right : truth rnd v small_path = true <-> small_amount > 2 * ET.
Proof.
  assert (X : truth rnd v small_path = negb (Rle_bool small_amount (2 * ET))) by small small_path.
  rewrite X, negb_true_iff. case Rle_bool_spec; split; intros; try easy; lra.
Qed.

(** A box of one pixel: up and right are 0. *)
Theorem small_one_right :
  fl v small_one_T = SmallBoxes.volume small_a small_b small_c /\
  fl v small_one_edge = small_edges 0 0 /\
  (truth rnd v small_one_inside = true <-> small_edges 0 0 >= - E) /\
  fl v small_one_least = rnd (small_near 0 0 - small_off) /\
  fl v small_one_most = rnd (small_near 0 0 + small_off) /\
  (truth rnd v small_one_sure = true <-> small_edges 0 0 > E).
Proof.
  assert (N : small_near 0 0 = nearness small_amount (var "na") (var "nb") (var "nc")
      (rnd (SmallBoxes.of_1 small_c small_a * small_s)) (rnd (SmallBoxes.of_1 small_a small_b * small_s)))
    by (unfold small_near; now rewrite !one_pixel).
  assert (A : fl v small_one_edge = small_edges 0 0)
    by (unfold small_edges; rewrite !one_pixel; small small_one_edge).
  rewrite N. clear N.
  split; [small small_one_T|]. split; [exact A|].
  split; [|split; [small small_one_least|split; [small small_one_most|]]].
  - change small_one_inside with (LessEq (Num (-2345391125639987) (-69)) small_one_edge).
    cbn [truth]. rewrite true_less_eq, A. cbn [value]. rewrite num_minus_E. lra.
  - change small_one_sure with (Less (Num 2345391125639987 (-69)) small_one_edge). cbn [truth].
    rewrite true_less, A. cbn [value]. rewrite num_E. lra.
Qed.
Theorem small_one_path_right : truth rnd v small_one_path = true <-> small_amount > 2 * ET.
Proof. exact small_path_right. Qed.

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
