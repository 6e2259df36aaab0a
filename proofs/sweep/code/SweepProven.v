(** The theorems of the sweep, about the recorded code.

    A pixel's functions are what `set_up` gave: the variables of the one record are the results of the
    other. Of `set_up` itself the vertices and the bounds are variables; what Film.v has to say of them
    is [fit], here as there. All is as if there were no largest float: see EdgeBounds.v. *)
Require Import ZArith Reals Psatz String Bool List.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Geometry Trees RecordedEdges RecordedPixels Rounding EdgeFunctions.
From Reftrace Require Import NearnessCommon NearnessPerspective NearnessParallel.
From Reftrace Require NearnessPixel NearnessDepths.
From Reftrace Require Import Cells SweepCode SweepDoubt SweepPixels.
Open Scope R_scope.
Open Scope string_scope.

(** What a block is handed: the edges, and whether T is sure. Those of parallel rays, and the first
    copy where it is not, are the same expressions: [parallel_is_perspective], [edge_on_is_perspective]. *)
Definition handed_edges (v w : renv) : Prop :=
  r_var w "bc_1" = fl v set_up_perspective_bc_1 /\
  r_var w "bc_y" = fl v set_up_perspective_bc_y /\
  r_var w "bc_x" = fl v set_up_perspective_bc_x /\
  r_var w "ca_1" = fl v set_up_perspective_ca_1 /\
  r_var w "ca_y" = fl v set_up_perspective_ca_y /\
  r_var w "ca_x" = fl v set_up_perspective_ca_x /\
  r_var w "ab_1" = fl v set_up_perspective_ab_1 /\
  r_var w "ab_y" = fl v set_up_perspective_ab_y /\
  r_var w "ab_x" = fl v set_up_perspective_ab_x /\
  r_var w "edge_error" = fl v set_up_perspective_edge_error /\
  r_given w "sure" = truth rnd v set_up_perspective_sure.
Definition handed_other (v w : renv) : Prop :=
  r_var w "bc_1" = fl v set_up_edge_on_other_bc_1 /\
  r_var w "bc_y" = fl v set_up_edge_on_other_bc_y /\
  r_var w "bc_x" = fl v set_up_edge_on_other_bc_x /\
  r_var w "ca_1" = fl v set_up_edge_on_other_ca_1 /\
  r_var w "ca_y" = fl v set_up_edge_on_other_ca_y /\
  r_var w "ca_x" = fl v set_up_edge_on_other_ca_x /\
  r_var w "ab_1" = fl v set_up_edge_on_other_ab_1 /\
  r_var w "ab_y" = fl v set_up_edge_on_other_ab_y /\
  r_var w "ab_x" = fl v set_up_edge_on_other_ab_x /\
  r_var w "edge_error" = fl v set_up_edge_on_other_edge_error.
Definition handed_perspective (v w : renv) : Prop :=
  r_var w "nearness_1" = fl v set_up_perspective_nearness_1 /\
  r_var w "nearness_y" = fl v set_up_perspective_nearness_y /\
  r_var w "nearness_x" = fl v set_up_perspective_nearness_x /\
  r_var w "nearness_error" = fl v set_up_perspective_nearness_error /\
  r_var w "nearest" = r_var v "nearest".
Definition handed_parallel (v w : renv) : Prop :=
  r_var w "nearness_1" = fl v set_up_parallel_nearness_1 /\
  r_var w "nearness_y" = fl v set_up_parallel_nearness_y /\
  r_var w "nearness_x" = fl v set_up_parallel_nearness_x /\
  r_var w "nearness_error" = fl v set_up_parallel_nearness_error.

Section Block.
Variables v w : renv.
Notation a := (corner_a v). Notation b := (corner_b v). Notation c := (corner_c v).
Variables a' b' c' : vec. (* the exact corners *)
Hypothesis ok : fit (place_ v) (weight_ v) (reach_ v) a b c a' b' c'.
Notation up := (up_ w). Notation right := (right_ w).
Hypothesis in_up : Rabs up <= reach_ v. Hypothesis in_right : Rabs right <= reach_ v.
Notation T := (det a' b' c').
Notation e_bc := (det b' c' (pixel_ray up right)).
Notation e_ca := (det c' a' (pixel_ray up right)).
Notation e_ab := (det a' b' (pixel_ray up right)).

Definition signed_least (s : R) : R :=
  Rmin (Rmin (signed_edge s b c up right) (signed_edge s c a up right)) (signed_edge s a b up right).
Lemma least_handed : handed_edges v w ->
  least_edge w up right = signed_least (s_ v) /\ r_var w "edge_error" = e_max v.
Proof.
  intros H. assert (S := set_up_perspective_edges v). unfold handed_edges in H.
  repeat match goal with H : _ /\ _ |- _ => destruct H end.
  split; [|congruence]. unfold least_edge, signed_least, at_, of_bc, of_ca, of_ab, signed_edge.
  cbn [l1 ly lx]. congruence.
Qed.
Lemma least_other : handed_other v w ->
  least_edge w up right = signed_least (- s_ v) /\ r_var w "edge_error" = e_max v.
Proof.
  intros H. assert (S := set_up_edge_on_other_edges v). unfold handed_other in H.
  repeat match goal with H : _ /\ _ |- _ => destruct H end.
  split; [|congruence]. unfold least_edge, signed_least, at_, of_bc, of_ca, of_ab, signed_edge.
  cbn [l1 ly lx]. congruence.
Qed.
Lemma up_float : is_float up. Proof. apply rnd_float. Qed.
Lemma right_float : is_float right. Proof. apply rnd_float. Qed.

(** Found, and sure: the ray meets the triangle, or its line does behind the eye, off all edges. *)
Theorem recorded_sure_inside : handed_edges v w -> truth rnd w block_sure = true ->
  T <> 0 /\ T * e_bc > 0 /\ T * e_ca > 0 /\ T * e_ab > 0 /\ T * (e_bc + e_ca + e_ab) > 0.
Proof.
  intros H S. destruct (block_right w) as [_ [_ [_ [_ B]]]]. apply B in S. destruct S as [S G].
  destruct (least_handed H) as [L E]. rewrite L, E in S.
  assert (Sure : amount_ v > t_max v).
  { apply (set_up_perspective_sign v). rewrite <- G. symmetry. apply H. }
  unfold signed_least in S.
  assert (M1 := Rmin_l (Rmin (signed_edge (s_ v) b c up right) (signed_edge (s_ v) c a up right))
    (signed_edge (s_ v) a b up right)).
  assert (M2 := Rmin_r (Rmin (signed_edge (s_ v) b c up right) (signed_edge (s_ v) c a up right))
    (signed_edge (s_ v) a b up right)).
  assert (M3 := Rmin_l (signed_edge (s_ v) b c up right) (signed_edge (s_ v) c a up right)).
  assert (M4 := Rmin_r (signed_edge (s_ v) b c up right) (signed_edge (s_ v) c a up right)).
  apply (sure_inside (place_ v) (weight_ v) (reach_ v) a b c a' b' c' ok up right up_float right_float
    in_up in_right Sure); fold (s_ v); change (edge_error _ _ _ _ _) with (e_max v); unfold s_, T_ in *; lra.
Qed.

(** Not found, and T is sure: the ray does not meet the triangle. *)
Theorem recorded_nothing_lost : handed_edges v w -> truth rnd v set_up_perspective_sure = true ->
  truth rnd w block_inside = false -> ~ (0 <= T * e_bc /\ 0 <= T * e_ca /\ 0 <= T * e_ab).
Proof.
  intros H S O. apply (set_up_perspective_sign v) in S. destruct (block_right w) as [_ [B _]].
  destruct (least_handed H) as [L E]. rewrite L, E in B.
  assert (N : signed_least (s_ v) < - e_max v).
  { apply Rnot_ge_lt. intros X. apply B in X. congruence. }
  exact (nothing_lost (place_ v) (weight_ v) (reach_ v) a b c a' b' c' ok up right up_float right_float
    in_up in_right S N).
Qed.

(** The nearness is between the two that come out. *)
Theorem recorded_perspective_nearness inverse rho :
  handed_edges v w -> handed_perspective v w -> truth rnd v set_up_perspective_sure = true ->
  is_float (r_var v "ray_error") -> 0 <= r_var v "ray_error" -> bpow radix2 (-960) <= r_var v "nearest" ->
  0 < inverse <= r_var v "nearest" ->
  Rabs ((e_bc + e_ca + e_ab) / T - inverse) <= rho * r_var v "nearest" ->
  0 <= rho <= 2 * r_var v "ray_error" /\ (2 * rho <= 2 * r_var v "ray_error" \/ rho <= 1 / 128) ->
  fl w block_least <= inverse <= fl w block_most.
Proof.
  intros H N S F P Q I O R. apply (set_up_perspective_sign v) in S.
  destruct (block_right w) as [_ [_ [-> [-> _]]]]. unfold most_at, at_, of_nearness. cbn [l1 ly lx].
  destruct N as [N1 [Ny [Nx [Ne Nn]]]]. destruct (set_up_perspective_nearness v) as [M1 [My [Mx Me]]].
  rewrite N1, Ny, Nx, Ne, Nn, M1, My, Mx, Me.
  set (given := NearnessPixel.Sure_pixel (place_ v) (weight_ v) (reach_ v) a b c a' b' c' up right ok
    in_up in_right S).
  exact (perspective_nearness (given := given) _ _ inverse rho F P Q I O R).
Qed.

(** The same of parallel rays; t is the mean of the exact depths, with the weights e / T. *)
Theorem recorded_parallel_nearness da' db' dc' :
  let da := r_var v "ta" in let db := r_var v "tb" in let dc := r_var v "tc" in
  let t := (e_bc * da' + e_ca * db' + e_ab * dc') / T in
  handed_edges v w -> handed_parallel v w -> truth rnd v set_up_parallel_sure = true ->
  is_float da -> is_float db -> is_float dc ->
  Rabs (da - da') <= own_ v -> Rabs (db - db') <= own_ v -> Rabs (dc - dc') <= own_ v ->
  16 * u * Rabs da <= own_ v -> 16 * u * Rabs db <= own_ v -> 16 * u * Rabs dc <= own_ v ->
  bpow radix2 (-900) <= own_ v -> vz a = 1 /\ vz a' = 1 /\ vz b' = 1 /\ vz c' = 1 ->
  0 <= T * e_bc /\ 0 <= T * e_ca /\ 0 <= T * e_ab -> - t <= r_var w "nearest" ->
  fl w block_least <= - t <= fl w block_most.
Proof.
  intros da db dc t H N S Fa Fb Fc Oa Ob Oc Ra Rb Rc Y W M Q. apply (set_up_parallel_sign v) in S.
  destruct (block_right w) as [_ [_ [-> [-> _]]]]. unfold most_at, at_, of_nearness. cbn [l1 ly lx].
  destruct N as [N1 [Ny [Nx Ne]]]. destruct (set_up_parallel_nearness v) as [M1 [My [Mx Me]]].
  rewrite N1, Ny, Nx, Ne, M1, My, Mx, Me.
  set (given := NearnessPixel.Sure_pixel (place_ v) (weight_ v) (reach_ v) a b c a' b' c' up right ok
    in_up in_right S).
  set (of_corners := NearnessDepths.Depths given da db dc (own_ v) da' db' dc' Fa Fb Fc (rnd_float _)
    Oa Ob Oc Ra Rb Rc Y W).
  exact (parallel_nearness (of_corners := of_corners) M _ Q).
Qed.

(** T has no sure sign, and neither copy is found at the pixel: the line of its ray does not meet the
    triangle. *)
Variable w2 : renv.
Hypothesis same_pixel : up_ w2 = up /\ right_ w2 = right.
Theorem recorded_nothing_lost_unsure : handed_edges v w -> handed_other v w2 ->
  truth rnd w block_inside = false -> truth rnd w2 block_inside = false ->
  ~ (0 <= e_bc /\ 0 <= e_ca /\ 0 <= e_ab) /\ ~ (e_bc <= 0 /\ e_ca <= 0 /\ e_ab <= 0).
Proof.
  intros H H2 O O2. destruct (least_handed H) as [L E].
  assert (L2 : least_edge w2 up right = signed_least (- s_ v) /\ r_var w2 "edge_error" = e_max v).
  { clear same_pixel. assert (S := set_up_edge_on_other_edges v). unfold handed_other in H2.
    repeat match goal with H : _ /\ _ |- _ => destruct H end.
    split; [|congruence]. unfold least_edge, signed_least, at_, of_bc, of_ca, of_ab, signed_edge.
    cbn [l1 ly lx]. congruence. }
  destruct L2 as [L2 E2]. destruct same_pixel as [P1 P2].
  destruct (block_right w) as [_ [B _]]. destruct (block_right w2) as [_ [B2 _]].
  rewrite L, E in B. rewrite P1, P2, L2, E2 in B2.
  assert (N : signed_least (s_ v) < - e_max v) by (apply Rnot_ge_lt; intros X; apply B in X; congruence).
  assert (N2 : signed_least (- s_ v) < - e_max v) by (apply Rnot_ge_lt; intros X; apply B2 in X; congruence).
  assert (K : signed_least 1 < - e_max v /\ signed_least (-1) < - e_max v).
  { destruct (sign_cases (T_ v)) as [S|S]; unfold s_ in N, N2; rewrite S in N, N2; split; try assumption.
    replace (- -1) with 1 in N2 by ring. exact N2. }
  destruct K as [K1 K2].
  exact (nothing_lost_unsure (place_ v) (weight_ v) (reach_ v) a b c a' b' c' ok up right up_float
    right_float in_up in_right K1 K2).
Qed.
End Block.

(** ** Cells: what is dropped of them would be found at no pixel, or be hidden there *)

Definition functions : list string :=
  "bc_1" :: "bc_y" :: "bc_x" :: "ca_1" :: "ca_y" :: "ca_x" :: "ab_1" :: "ab_y" :: "ab_x" ::
  "nearness_1" :: "nearness_y" :: "nearness_x" :: "edge_error" :: "nearness_error" :: nil.
Theorem recorded_cell (w p : renv) : (forall n, In n functions -> r_var p n = r_var w n) ->
  up0 w <= up_ p <= up1 w -> right0 w <= right_ p <= right1 w -> truth rnd w may_be_seen = false ->
  truth rnd p block_inside = false \/ fl p block_most < r_var w "farthest".
Proof.
  intros F U R M. destruct (block_right p) as [_ [B [_ [-> _]]]].
  assert (G : of_bc p = of_bc w /\ of_ca p = of_ca w /\ of_ab p = of_ab w /\
    of_nearness p = of_nearness w /\ r_var p "edge_error" = r_var w "edge_error" /\
    r_var p "nearness_error" = r_var w "nearness_error").
  { unfold of_bc, of_ca, of_ab, of_nearness. rewrite !F by (simpl; auto 20).
    repeat split. }
  destruct G as [G1 [G2 [G3 [G4 [G5 G6]]]]].
  unfold least_edge in B. rewrite G1, G2, G3, G5 in B. rewrite G4, G6. unfold most_in in *.
  destruct (Rlt_or_le (Rmin (Rmin (most_in w (of_bc w)) (most_in w (of_ca w))) (most_in w (of_ab w)))
    (- r_var w "edge_error")) as [X|X].
  - left. apply not_true_iff_false. intros Y. apply B in Y. revert Y.
    exact (ruled_out _ _ _ _ _ _ _ _ X _ _ U R).
  - right. destruct (Rlt_or_le (rnd (most_in w (of_nearness w) + r_var w "nearness_error"))
      (r_var w "farthest")) as [Z|Z].
    + exact (hidden _ _ _ _ _ _ _ _ Z _ _ U R).
    + exfalso. apply not_true_iff_false in M. apply M, may_be_seen_right.
      unfold most_in in *. split; apply Rle_not_lt; assumption.
Qed.

(** ** The clip range *)

Section Clip.
Variables (v : renv) (t : R).
Notation start := (r_var v "start"). Notation end_ := (r_var v "end").
Notation least := (r_var v "least"). Notation most := (r_var v "most").

Theorem recorded_clip_perspective : 0 < start <= bpow radix2 1024 /\ 0 < end_ <= bpow radix2 1024 ->
  0 < t /\ least <= / t <= most ->
  (truth rnd v clip_perspective_inside = true -> start < t < end_) /\
  (truth rnd v clip_perspective_outside = true -> t < start \/ end_ < t).
Proof.
  intros [S E] H. destruct (clip_perspective_right v) as [I O]; [lra|]. rewrite I, O. split.
  - intros [L M]. exact (surely_inside _ _ _ _ t (conj S E) H L M).
  - intros L. exact (surely_outside _ _ _ _ t (conj S E) H L).
Qed.
Theorem recorded_clip_parallel : least <= - t <= most ->
  (truth rnd v clip_parallel_inside = true -> start < t < end_) /\
  (truth rnd v clip_parallel_outside = true -> t < start \/ end_ < t).
Proof. intros H. destruct (clip_parallel_right v) as [-> ->]. lra. Qed.
Theorem recorded_plane : 0 < r_var v "low" -> r_var v "low" <= t <= r_var v "high" ->
  r_var v "high" <= bpow radix2 1024 ->
  fl v plane_pixel_perspective_least <= / t <= fl v plane_pixel_perspective_most /\
  fl v plane_pixel_parallel_least <= - t <= fl v plane_pixel_parallel_most.
Proof.
  intros L H M. destruct (plane_pixel_perspective_right v L) as [-> [-> _]].
  destruct (plane_pixel_parallel_right v) as [-> [-> _]]. split; [|lra].
  now apply nearness_encloses.
Qed.
End Clip.
