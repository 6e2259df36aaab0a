(** The theorem of the checker of certificates, of all that it does at a pixel: floats drop surfaces from
    squares of pixels, integers decide of the rest, and what is found is the file's.

    [LeafYes.v] has the integers, [Dropping.v] what is dropped from a square whose box has the ray in it,
    [Box.v] that box. Left to Python are the arrays: that the variables of a square are those of [around]. *)
Require Import ZArith Reals Psatz String List Bool Classical.
From Flocq Require Import Core.
From Flocq Require BinarySingleNaN.
From Reftrace Require Import Geometry Trees Rounding Magnitude.
From Reftrace Require Import RecordedDropping.
From Reftrace Require Import Contest Facts CodeAnswers.
From Reftrace Require Leaf Dropping Box.
From Reftrace Require Import Dropped LeafRight LeafYes.
Import ListNotations.
Open Scope R_scope.
Open Scope string_scope.

Notation known x := (BinarySingleNaN.is_finite x = true).
Notation real := BinarySingleNaN.B2R.

(** A square of pixels: the least and the largest components of its r, the largest of all r's, and far.
    r is the ray's direction; of parallel rays, its origin less the camera's. *)
Record square := Square { low : floats; high : floats; largest : float; far_ : float }.
(** The camera: its position and its backward axis. (The vector q may be any.) *)
Record camera := Camera { is_parallel : bool; eye : floats; back : floats }.

(** ** The recorded code, of one surface in one square *)

(** What its variables are. *)
Definition floats_at (v : env) (name : string) : floats :=
  F3 (of_var v (name ++ "x")) (of_var v (name ++ "y")) (of_var v (name ++ "z")).
Record describes (v : env) (cam : camera) (start : float) (q : square) (s : stored) : Prop := {
  eye_is : floats_at v "eye" = eye cam;
  back_is : floats_at v "back" = back cam;
  start_is : of_var v "start" = start;
  low_is : floats_at v "low" = low q;
  high_is : floats_at v "high" = high q;
  largest_is : of_var v "largest" = largest q;
  far_is : of_var v "far" = far_ q;
  middle_is : floats_at v "middle" = F3 (eval v square_middle_x) (eval v square_middle_y) (eval v square_middle_z);
  half_is : floats_at v "half" = F3 (eval v square_half_x) (eval v square_half_y) (eval v square_half_z);
  surface_is : match s with
    | StoredTriangle a b c => floats_at v "a" = a /\ floats_at v "b" = b /\ floats_at v "c" = c
    | StoredPlane p n => floats_at v "a" = p /\ floats_at v "b" = n
    end }.
Definition code_drops (v : env) (parallel : bool) (s : stored) : bool :=
  holds v match s, parallel with
    | StoredTriangle _ _ _, false => gone_triangle_point
    | StoredTriangle _ _ _, true => gone_triangle_parallel
    | StoredPlane _ _, false => gone_plane_point
    | StoredPlane _ _, true => gone_plane_parallel
    end.

Lemma floats_eta v : v = F3 (fx v) (fy v) (fz v).
Proof. now destruct v. Qed.

(** The box around r. *)
Definition between (least x most top : float) : Prop :=
  known x /\ - real top <= real least <= real x /\ real x <= real most <= real top.
Definition within (r : floats) (q : square) : Prop := known (largest q) ->
  between (fx (low q)) (fx r) (fx (high q)) (largest q) /\
  between (fy (low q)) (fy r) (fy (high q)) (largest q) /\
  between (fz (low q)) (fz r) (fz (high q)) (largest q).
Lemma one_side v r x middle half l h :
  middle = eval v (Box.middle_code l h) -> half = eval v (Box.half_code l h) ->
  known middle -> known half -> between (of_var v l) r (of_var v h) (of_var v "largest") ->
  let L := real (of_var v "largest") in Rabs (x - real r) <= 2 * u * L ->
  Rabs (real middle) <= L /\ 0 <= real half <= 4 * L /\ Rabs (x - real middle) <= real half + 2 * u * L.
Proof.
  intros -> -> M H (_ & A & B) L N.
  destruct (Box.code_covers v l h ltac:(lra) (real r) L (B2R_is_float _) ltac:(unfold L; lra) ltac:(unfold L;
    lra)
    ltac:(lra) M H) as (P & Q & R). split; [exact P|]. split; [exact Q|].
  replace (x - _) with ((real r - real (eval v (Box.middle_code l h))) + (x - real r)) by ring.
  eapply Rle_trans; [apply Rabs_triang | lra].
Qed.
Lemma in_box v cam start q s r x y z : describes v cam start q s -> within r q ->
  (known (largest q) -> let near x r := Rabs (x - real r) <= 2 * u * real (largest q) in
   near x (fx r) /\ near y (fy r) /\ near z (fz r)) ->
  Dropping.boxed v x y z.
Proof.
  intros [] W N K L. injection middle_is0 as Mx My Mz. injection half_is0 as Hx Hy Hz.
  injection (eq_trans low_is0 (floats_eta _)) as Lx Ly Lz.
  injection (eq_trans high_is0 (floats_eta _)) as Bx By Bz.
  assert (KL := K "largest" ltac:(simpl; tauto)). revert W N. unfold within, between. subst L.
  cbn [real_env r_var].
  rewrite <- Lx, <- Ly, <- Lz, <- Bx, <- By, <- Bz, <- largest_is0. intros W N.
  destruct (W KL) as (X & Y & Z). destruct (N KL) as (Nx & Ny & Nz). clear W N KL.
  assert (Kx := K "middlex" ltac:(simpl; tauto)). assert (Ky := K "middley" ltac:(simpl; tauto)).
  assert (Kz := K "middlez" ltac:(simpl; tauto)). assert (Jx := K "halfx" ltac:(simpl; tauto)).
  assert (Jy := K "halfy" ltac:(simpl; tauto)). assert (Jz := K "halfz" ltac:(simpl; tauto)).
  destruct (one_side v _ _ _ _ "lowx" "highx" Mx Hx Kx Jx X Nx) as (A1 & A2 & A3).
  destruct (one_side v _ _ _ _ "lowy" "highy" My Hy Ky Jy Y Ny) as (B1 & B2 & B3).
  destruct (one_side v _ _ _ _ "lowz" "highz" Mz Hz Kz Jz Z Nz) as (C1 & C2 & C3).
  split; [exact (conj A1 (conj B1 C1))|]. split; [exact (conj A2 (conj B2 C2))|].
  exact (conj A3 (conj B3 C3)).
Qed.

Section Pixel.
Variable p : Leaf.pixel.
Notation r := (Leaf.stored_ray p).
Notation start := (Leaf.start p).
Notation end_ := (Leaf.end_ p).

(** What varies from ray to ray, as computed. *)
Definition minus (u v : floats) : floats :=
  let sub := BinarySingleNaN.Bminus BinarySingleNaN.mode_NE in
  F3 (sub (fx u) (fx v)) (sub (fy u) (fy v)) (sub (fz u) (fz v)).
Definition opposite (v : floats) : floats :=
  F3 (BinarySingleNaN.Bopp (fx v)) (BinarySingleNaN.Bopp (fy v)) (BinarySingleNaN.Bopp (fz v)).
Definition varying (cam : camera) : floats :=
  if is_parallel cam then minus (Leaf.origin p) (eye cam) else Leaf.direction p.
(** The ray is the camera's. *)
Definition of_camera (cam : camera) : Prop :=
  if is_parallel cam then Leaf.direction p = opposite (back cam) else Leaf.origin p = eye cam.
(** The square is around the ray. [largest] is the largest |component| of all r: where it is finite, so is
    the ray's r, and between the square's ends. [far] is no nearer than that of the pixel. *)
Definition around (cam : camera) (q : square) (said : Leaf.answer) : Prop :=
  within (varying cam) q /\ (known (far_ q) -> forall x, not_beyond x (far p said) -> x <= real (far_ q)).

(** ** A surface that is dropped is not met up to the farthest t that matters *)

Section Around.
Variables (cam : camera) (q : square) (said : Leaf.answer) (s : surface).
Hypothesis camera_is : of_camera cam.
Hypothesis around_it : around cam q said.
Variable v : env.
Hypothesis described : describes v cam (Leaf.clip_start p) q (Leaf.floats_of p s).
Notation w := (real_env v).
Definition r_of : vec := if is_parallel cam then vsub (origin r) (reals (eye cam)) else direction r.

Lemma difference_near (x y : float) L : known (BinarySingleNaN.Bminus BinarySingleNaN.mode_NE x y) ->
  Rabs (real (BinarySingleNaN.Bminus BinarySingleNaN.mode_NE x y)) <= L ->
  Rabs ((real x - real y) - real (BinarySingleNaN.Bminus BinarySingleNaN.mode_NE x y)) <= 2 * u * L.
Proof.
  intros F. rewrite (minus_value _ _ F). intros H. assert (U := u_pos). assert (Us := u_small).
  assert (E : Rabs (rnd (real x - real y) - (real x - real y)) <= u * Rabs (real x - real y)).
  { unfold Rminus. apply rnd_err_sum; [apply B2R_is_float | apply is_float_opp, B2R_is_float]. }
  set (e := real x - real y) in *.
  assert (A : Rabs e <= Rabs (rnd e) + Rabs (rnd e - e)) by (unfold Rabs; repeat destruct Rcase_abs; lra).
  rewrite <- Rabs_Ropp. replace (- (e - rnd e)) with (rnd e - e) by ring.
  assert (P := Rabs_pos e). assert (u * Rabs e <= / 2 * Rabs e) by (apply Rmult_le_compat_r; lra).
  assert (Q : Rabs e <= 2 * L) by lra.
  assert (u * Rabs e <= u * (2 * L)) by (apply Rmult_le_compat_l; lra). lra.
Qed.
Lemma is_boxed : Dropping.boxed v (vx r_of) (vy r_of) (vz r_of).
Proof.
  apply (in_box _ _ _ _ _ (varying cam) _ _ _ described (proj1 around_it)).
  intros K. destruct (proj1 around_it K) as ((Fx & Lx & Hx) & (Fy & Ly & Hy) & (Fz & Lz & Hz)).
  unfold r_of, varying in *. destruct (is_parallel cam).
  - cbn [minus fx fy fz] in *. unfold vsub, reals. cbn [vx vy vz origin].
    repeat split; apply difference_near; auto; apply Rabs_le; lra.
  - cbn [direction vx vy vz reals]. unfold Rminus. rewrite !Rplus_opp_r, Rabs_R0.
    assert (0 <= u * real (largest q)) by (apply Rmult_le_pos; [apply Rlt_le, u_pos | lra]). lra.
Qed.
Definition last : R := if BinarySingleNaN.is_finite (far_ q) then real (far_ q) else t r s.
Lemma last_is : known (of_var v "far") -> last = r_var w "far".
Proof. unfold last. cbn [real_env r_var]. rewrite (far_is _ _ _ _ _ described). now intros ->. Qed.
Lemma real_at name f : floats_at v name = f -> Dropping.real_of v name = reals f.
Proof. now intros <-. Qed.
Hypothesis stored_is : shape_of s = shape_stored (Leaf.floats_of p s).
Theorem is_ruled_out : code_drops v (is_parallel cam) (Leaf.floats_of p s) = true ->
  ruled_out r s start last.
Proof.
  assert (B := is_boxed). assert (L := last_is).
  assert (S : start = r_var w "start") by (cbn [real_env r_var]; now rewrite (start_is _ _ _ _ _ described)).
  assert (E := real_at _ _ (eye_is _ _ _ _ _ described)). assert (Bk := back_is _ _ _ _ _ described).
  assert (Su := surface_is _ _ _ _ _ described). rewrite S. clear S.
  unfold of_camera in camera_is. unfold code_drops, Leaf.stored_ray. unfold r_of in B.
  destruct (is_parallel cam); destruct (Leaf.floats_of p s) as [a b c|a n]; cbn [shape_stored] in stored_is;
    intros H.
  - destruct Su as (A1 & A2 & A3). apply real_at in A1, A2, A3. rewrite <- A1, <- A2, <- A3 in stored_is.
    rewrite camera_is, <- Bk. cbn [vsub vx vy vz] in B. rewrite <- E in B.
    assert (Q := Dropping.triangle_parallel_ruled_out v s _ _ _ last B L (reals (Leaf.origin p))
      eq_refl eq_refl eq_refl stored_is H). revert Q. unfold reals, opposite, floats_at. cbn [fx fy fz].
    rewrite !BinarySingleNaN.B2R_Bopp. easy.
  - destruct Su as (A1 & A2). apply real_at in A1, A2. rewrite <- A1, <- A2 in stored_is.
    rewrite camera_is, <- Bk. cbn [vsub vx vy vz] in B. rewrite <- E in B.
    assert (Q := Dropping.plane_parallel_ruled_out v s _ _ _ last B L (reals (Leaf.origin p))
      eq_refl eq_refl eq_refl stored_is H). revert Q. unfold reals, opposite, floats_at. cbn [fx fy fz].
    rewrite !BinarySingleNaN.B2R_Bopp. easy.
  - destruct Su as (A1 & A2 & A3). apply real_at in A1, A2, A3. rewrite <- A1, <- A2, <- A3 in stored_is.
    rewrite camera_is, <- E. apply (Dropping.triangle_point_ruled_out v s _ _ _ last B L stored_is H).
  - destruct Su as (A1 & A2). apply real_at in A1, A2. rewrite <- A1, <- A2 in stored_is.
    rewrite camera_is, <- E. apply (Dropping.plane_point_ruled_out v s _ _ _ last B L stored_is H).
Qed.
End Around.

(** ** The theorem *)

Context {scene kept : list surface}.
Variable cam : camera.
Hypothesis G : given p scene.
Hypothesis scene_once : NoDup scene.
Hypothesis kept_once : NoDup kept.
Hypothesis kept_some : incl kept scene.
Hypothesis camera_is : of_camera cam.

(** Why a surface is not kept: the code has dropped it from some square around the ray. *)
Definition dropped (said : Leaf.answer) (s : surface) : Prop := exists q v, around cam q said /\
  describes v cam (Leaf.clip_start p) q (Leaf.floats_of p s) /\
  code_drops v (is_parallel cam) (Leaf.floats_of p s) = true.
Lemma dropped_not_met said s : In s scene -> dropped said s -> met r start end_ scene s ->
  ~ not_beyond (t r s) (far p said).
Proof.
  intros I (q & v & A & E & H) M B. assert (S := proj2 (scene_stored p _ G s I)).
  assert (R := is_ruled_out cam q said s camera_is A v E S H).
  apply (dropped_is_not_met r start end_ [s] [] (last q s)) with (s := s).
  - intros s' [<-|[]] _. exact R.
  - split; [now left | apply M].
  - unfold last. destruct (BinarySingleNaN.is_finite (far_ q)) eqn:F; [|lra].
    exact (proj2 A F _ B).
Qed.
(** Whatever is in the file: if each surface that is not kept was dropped by the code, and what is found
    of those that are kept is what the file says of the pixel, it is so. *)
Theorem checked_is_right said :
  (forall s, In s scene -> ~ In s kept -> dropped said s) ->
  Leaf.found p kept = Some said -> is_so p (scene := scene) said.
Proof.
  intros K. apply (yes_is_right p G scene_once kept_once kept_some). intros s M B.
  apply NNPP. intros N. exact (dropped_not_met said s (proj1 M) (K s (proj1 M) N) M B).
Qed.
End Pixel.
