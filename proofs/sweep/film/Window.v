(** The picture's window and one of its pixels: what perspective and orthographic cameras share.

    Perspective.v, Orthographic.v, Fit.v and FitParallel.v name these premises alike. *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding Camera Place Film Dual Bounds Boxes.
Open Scope R_scope.
Opaque rnd.

Section Window.
Variables x0 x1 y0 y1 : R.
Variables width height : Z.
Notation n := (IZR width).
Notation n' := (IZR height).
Hypothesis sizes : (1 <= width < 2 ^ 40)%Z /\ (1 <= height < 2 ^ 40)%Z.
Hypothesis window_ok : x0 < x1 /\ y0 < y1.
Notation ax := (window x0 x1 n).
Notation ay := (window y0 y1 n').
Hypothesis pixels : bpow radix2 (-1020) <= pixel ax <= bpow radix2 1000 /\
  bpow radix2 (-1020) <= pixel ay <= bpow radix2 1000.

Lemma counts : 1 <= n /\ 1 <= n' /\ n <= bpow radix2 40 /\ n' <= bpow radix2 40.
Proof.
  destruct sizes as [[A B] [C D]]. rewrite <- (IZR_Zpower radix2 40) by lia.
  repeat split; apply IZR_le; simpl; lia.
Qed.
Lemma axes_ok : axis_ok ax /\ axis_ok ay.
Proof.
  destruct counts as [A [B _]]. split; (split; [apply pixels | split; [assumption|]]); simpl;
    (eapply Rle_trans; [apply Rabs_pos | apply Rmax_l]).
Qed.

Variables (i j : Z) (dx dy : R). (* the pixel, and where in it all rays pass *)
Hypothesis i_pixel : (0 <= i < width)%Z.
Hypothesis j_pixel : (0 <= j < height)%Z.
Hypothesis shift : Rabs dx <= / 2 /\ Rabs dy <= / 2.

Lemma in_picture_both : in_picture ax (IZR i) dx /\ in_picture ay (IZR j) dy.
Proof.
  destruct counts as [A [B [C D]]].
  split; apply window_holds; try assumption; try apply window_ok; try apply shift; try apply pixels;
    try (apply IZR_le; lia); rewrite <- plus_IZR; apply IZR_le; lia.
Qed.
End Window.

(** Axes whose dual axes are known well: of parallel rays, where no factor of theirs cancels. *)
Lemma exactly_near right up forward m S :
  floats right /\ floats up /\ floats forward ->
  dot right right <= 401 / 100 /\ dot up up <= 401 / 100 /\ dot forward forward <= 401 / 100 ->
  1249 / 10000 <= Rabs (volume right up forward) ->
  permanent right up forward <= 119 / 10 * Rabs (volume right up forward) ->
  within right m /\ within up m /\ within forward m -> / 4 <= m <= 201 / 100 ->
  near S (nine right up forward) (nine right up forward / 10000) ->
  off_by 1 (dr right up forward) (dual_right right up forward) <= 100 * (u * S) /\
  off_by 1 (du right up forward) (dual_up right up forward) <= 100 * (u * S) /\
  off_by 1 (df right up forward) (dual_depth right up forward) <= 100 * (u * S) /\ Rabs (1 - 1) <= / 100.
Proof.
  intros. assert (One : Rabs (1 - 1) <= / 100) by (replace (1 - 1) with 0 by ring; rewrite Rabs_R0; lra).
  unfold off_by. repeat split; try exact One;
    eapply dual_near_exactly; try eassumption; tauto.
Qed.

(** ** The least of three, and the greatest *)

Lemma least_of_three x y z t : x <= t \/ y <= t \/ z <= t -> Rmin x (Rmin y z) <= t.
Proof.
  intros [H|[H|H]].
  - eapply Rle_trans; [apply Rmin_l | exact H].
  - eapply Rle_trans; [apply Rmin_r|]. eapply Rle_trans; [apply Rmin_l | exact H].
  - eapply Rle_trans; [apply Rmin_r|]. eapply Rle_trans; [apply Rmin_r | exact H].
Qed.
Lemma greatest_of_three x y z t : t <= x \/ t <= y \/ t <= z -> t <= Rmax x (Rmax y z).
Proof.
  intros [H|[H|H]]; (eapply Rle_trans; [exact H|]);
    [apply Rmax_l | eapply Rle_trans; [apply Rmax_l | apply Rmax_r] |
     eapply Rle_trans; [apply Rmax_r | apply Rmax_r]].
Qed.

(** The box of three corners: each end is that of the corner that is farthest out. *)
Section Box.
Variables (low_x high_x low_y high_y : vec -> R -> R) (f g : vec -> R) (i j : R).
Definition bounds_corner v Z := (f v <= 0 -> low_x v Z <= i) /\ (0 <= f v -> high_x v Z <= - i) /\
  (g v <= 0 -> low_y v Z <= j) /\ (0 <= g v -> high_y v Z <= - j).
Lemma box_of_three a b c Za Zb Zc :
  (f a <= 0 \/ f b <= 0 \/ f c <= 0) /\ (0 <= f a \/ 0 <= f b \/ 0 <= f c) /\
  (g a <= 0 \/ g b <= 0 \/ g c <= 0) /\ (0 <= g a \/ 0 <= g b \/ 0 <= g c) ->
  bounds_corner a Za -> bounds_corner b Zb -> bounds_corner c Zc ->
  Rmin (low_x a Za) (Rmin (low_x b Zb) (low_x c Zc)) <= i /\
  Rmin (high_x a Za) (Rmin (high_x b Zb) (high_x c Zc)) <= - i /\
  Rmin (low_y a Za) (Rmin (low_y b Zb) (low_y c Zc)) <= j /\
  Rmin (high_y a Za) (Rmin (high_y b Zb) (high_y c Zc)) <= - j.
Proof.
  intros [F [F' [G G']]] [a1 [a2 [a3 a4]]] [b1 [b2 [b3 b4]]] [c1 [c2 [c3 c4]]].
  split; [|split; [|split]]; apply least_of_three.
  - destruct F as [H|[H|H]]; auto.
  - destruct F' as [H|[H|H]]; auto.
  - destruct G as [H|[H|H]]; auto.
  - destruct G' as [H|[H|H]]; auto.
Qed.
End Box.
