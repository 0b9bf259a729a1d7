import numpy as np,subprocess,re,sys
def run(e,f,args):
    try: r=subprocess.run(['nice','-n','5',e,'fit',f,'--units','mm',*args.split(),'--primitives'],capture_output=True,text=True,timeout=100)
    except subprocess.TimeoutExpired: return 'timeout'
    t=r.stdout;v=re.search(r"(\d+) vertices?.*?(\d+) inflec",t)
    return r.returncode,len(re.findall(r"^\d+-\d+ +straight +- ",t,re.M)),len(re.findall(r"^\d+-\d+ +-?[\d.]+ +-?[\d.e-]+ +-?[\d.e-]+ +",t,re.M)),v and v.groups(),'proved:' in t,r.stderr[:110].replace('\n',' ')
for seed in range(8):
    rng=np.random.default_rng(900+seed)
    m=[3,4,5,6][seed%4];a=np.arange(m)*2*np.pi/m+rng.uniform(0,.5,m);V=np.c_[40*np.cos(a),30*np.sin(a)]
    L=np.hypot(*(np.roll(V,-1,0)-V).T);tot=L.sum();s=np.arange(.3,tot,1.1);P=[]
    cum=np.r_[0,np.cumsum(L)]
    for x in s:
        k=np.searchsorted(cum,x,side='right')-1;t=(x-cum[k])/L[k];P.append(V[k]+t*(np.roll(V,-1,0)[k]-V[k]))
    P=np.array(P)+rng.normal(0,.01,(len(P),2));np.savetxt('c%d.csv'%seed,P,fmt='%.4f',delimiter=',')
    print('cut corners',m,[run(e,'c%d.csv'%seed,'--closed --noise 0.04') for e in sys.argv[1:]])
for seed in range(8):
    f='/tmp/r18/lens_%d.csv'%seed
    print('lens',[run(e,f,'--closed --noise 0.03') for e in sys.argv[1:]])
